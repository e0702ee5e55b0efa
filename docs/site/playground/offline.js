// SPDX-License-Identifier: MIT
// A service worker: it keeps what the page has loaded, and serves that while the server cannot be reached. Otherwise, what the server has counts.
const shelves = 'tactus-playground-', shelf = `${shelves}BUILD`;   // build_playground.py puts the hash of all files here, so a new build begins with nothing

/** Keeps an answer if it can: there may be no room. */
async function keep (request, answer)
{
    try { await (await caches.open (shelf)).put (request, answer); }
    catch (error) { console.warn (`not kept for later: ${request.url}: ${error}`); }
}

async function answerTo ({ request }, whileKept)
{
    let answer;
    try { answer = await fetch (request); }
    catch (error)
    {
        const kept = await (await caches.open (shelf)).match (request, { ignoreVary: true });
        if (! kept) throw error;
        return kept;
    }
    if (answer.status === 200) whileKept (keep (request, answer.clone()));   // not a part of a file
    return answer;
}

async function begin()
{
    for (const name of await caches.keys())
        if (name.startsWith ('tactus-playground') && name !== shelf) await caches.delete (name);
    await clients.claim();
}

addEventListener ('install', () => skipWaiting());
addEventListener ('activate', event => event.waitUntil (begin()));
addEventListener ('fetch', event => {
    if (event.request.method === 'GET') event.respondWith (answerTo (event, work => event.waitUntil (work)));
});
