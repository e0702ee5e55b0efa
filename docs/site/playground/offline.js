// SPDX-License-Identifier: MIT
// A service worker: it keeps what the page has loaded, and serves that while the server cannot be reached. Otherwise, what the server has counts.
async function answerTo (request)
{
    const shelf = await caches.open ('tactus-playground');
    try
    {
        const answer = await fetch (request);
        if (answer.ok) await shelf.put (request, answer.clone());
        return answer;
    }
    catch (error)
    {
        const kept = await shelf.match (request, { ignoreVary: true });
        if (! kept) throw error;
        return kept;
    }
}

addEventListener ('install', () => skipWaiting());
addEventListener ('activate', event => event.waitUntil (clients.claim()));
addEventListener ('fetch', event => { if (event.request.method === 'GET') event.respondWith (answerTo (event.request)); });
