// SPDX-License-Identifier: MIT
// node offline_test.mjs SITE: what the playground is given by its service worker, while the server answers, refuses, or cannot be reached. The worker is that
// of the page; the server and the browser's store are simulated here.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';

const source = readFileSync (`${process.argv[2]}/offline.js`, 'utf8');
const shelf_name = /`\$\{shelves\}([0-9a-f]{16})`/.exec (source)?.[1];
assert (shelf_name, 'the name of the shelf has the hash of the build');

/** A browser with a store that is kept, and a server. */
class Browser
{
    stores = new Map();
    listeners = {};
    server = () => { throw new TypeError ('Failed to fetch'); };
    full = false;

    constructor (code = source)
    {
        const open = async name => {
            if (! this.stores.has (name)) this.stores.set (name, new Map());
            const store = this.stores.get (name);
            return {
                put: async (request, answer) => {
                    if (this.full) throw new Error ('QuotaExceededError');
                    if (answer.status === 206) throw new TypeError ('a part cannot be kept');
                    store.set (request.url, answer);
                },
                match: async request => store.get (request.url),
            };
        };
        const caches = { open, keys: async () => [...this.stores.keys()], delete: async name => this.stores.delete (name) };
        const clients = { claim: async () => { this.has_claimed = true; } };
        const run = new Function ('caches', 'clients', 'fetch', 'addEventListener', 'skipWaiting', 'console', code);
        run (caches, clients, async request => this.server (request), (what, call) => { this.listeners[what] = call; }, () => {}, { warn() {} });
    }

    async activate()
    {
        let done;
        this.listeners.activate ({ waitUntil: work => { done = work; } });
        await done;
    }

    /** What the page gets. Undefined: the worker leaves the request to the browser. */
    get (url, method = 'GET')
    {
        let answer;
        const kept = [];
        this.listeners.fetch ({ request: { url, method }, respondWith: given => { answer = given; }, waitUntil: work => kept.push (work) });
        return answer?.then (async given => { await Promise.all (kept); return given; });
    }
}

const response = (text, status = 200) => ({ text, status, clone() { return response (text, status); } });
const serves = (text, status) => () => response (text, status);
const gone = () => { throw new TypeError ('Failed to fetch'); };

const tests = {
    async 'what the server has counts, and is kept for later'()
    {
        const browser = new Browser();
        browser.server = serves ('first');
        assert.equal ((await browser.get ('a.wasm')).text, 'first');
        browser.server = serves ('second');
        assert.equal ((await browser.get ('a.wasm')).text, 'second');
        browser.server = gone;
        assert.equal ((await browser.get ('a.wasm')).text, 'second');
    },
    async 'without the server, what was never loaded is an error'()
    {
        const browser = new Browser();
        await assert.rejects (browser.get ('a.wasm'), /Failed to fetch/);
    },
    async 'a module that the server has withdrawn is not taken from the store'()
    {
        const browser = new Browser();
        browser.server = serves ('old');
        await browser.get ('a.wasm');
        for (const status of [404, 410, 403, 500])
        {
            browser.server = serves ('refused', status);
            const answer = await browser.get ('a.wasm');
            assert.deepEqual ([answer.status, answer.text], [status, 'refused']);
        }
        browser.server = gone;
        assert.equal ((await browser.get ('a.wasm')).text, 'old');   // a refusal is not kept
    },
    async 'an answer that cannot be kept is still the answer, not an older one'()
    {
        const browser = new Browser();
        browser.server = serves ('old limits');
        await browser.get ('profiles.json');
        browser.full = true;
        browser.server = serves ('new limits');
        assert.equal ((await browser.get ('profiles.json')).text, 'new limits');
        browser.full = false;
        browser.server = serves ('a part', 206);
        assert.equal ((await browser.get ('profiles.json')).text, 'a part');
    },
    async 'a new build takes nothing of an older one, and touches no store of other pages'()
    {
        const browser = new Browser (source.replace (shelf_name, '0123456789abcdef'));
        browser.server = serves ('old limits');
        await browser.activate();
        await browser.get ('profiles.json');
        const next = new Browser();
        next.stores = browser.stores;
        next.stores.set ('another page', new Map());
        await next.activate();
        assert (next.has_claimed);
        assert.deepEqual ([...next.stores.keys()], ['another page']);
        await assert.rejects (next.get ('profiles.json'), /Failed to fetch/);
    },
    async 'a request that changes something is left to the browser'()
    {
        assert.equal (new Browser().get ('a', 'POST'), undefined);
    },
};

for (const [name, test] of Object.entries (tests))
{
    await test();
    console.log (`ok: ${name}`);
}
