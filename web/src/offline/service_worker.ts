// Keeps the page for when there is no server. What is kept belongs to one build, named by the hash of
// its files, and is let go when no page of that build is open any more. The page itself is asked for
// anew at each load, so that one that is served anew is taken at once; its other files have the hash
// of what they hold in their names, and never change.

/** Put in by the build (vite.config.ts): its files but the page, and the hash of them all. */
declare const BUILD_FILES: readonly string[];
declare const BUILD_HASH: string;

/** What of the service worker's scope is used here; the page's types know none. */
interface Extended extends Event {
  waitUntil(what: Promise<unknown>): void;
}
interface Asked extends Extended {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
const scope = globalThis as unknown as {
  readonly registration: { readonly scope: string };
  addEventListener(kind: "install" | "activate", listener: (event: Extended) => void): void;
  addEventListener(kind: "fetch", listener: (event: Asked) => void): void;
};

const here = scope.registration.scope;
const page = new URL("index.html", here).href;
const files = new Set(BUILD_FILES.map((name) => new URL(name, here).href));
const ours = `pendula ${here} `; // other pages of this origin have caches, too
const own = ours + BUILD_HASH;

scope.addEventListener("install", (event) => event.waitUntil(keep()));
scope.addEventListener("activate", (event) => event.waitUntil(forget()));
scope.addEventListener("fetch", (event) => {
  const address = event.request.url.replace(/[?#].*$/, "");
  if (address === here || address === page) event.respondWith(opened(event.request));
  else if (files.has(address)) event.respondWith(found(event.request));
});

async function keep(): Promise<void> {
  const cache = await caches.open(own);
  await cache.addAll([...files]);
  const answer = await fetch(page, { cache: "no-cache" });
  if (!answer.ok) throw new Error(`${page}: ${answer.status}`);
  // a server may send another address for it, which no browser opens a page with
  await cache.put(page, new Response(await answer.blob(), { headers: answer.headers }));
}

async function forget(): Promise<void> {
  const old = (await caches.keys()).filter((name) => name.startsWith(ours) && name !== own);
  await Promise.all(old.map((name) => caches.delete(name)));
}

async function opened(request: Request): Promise<Response> {
  try {
    return await fetch(request, { cache: "no-cache" });
  } catch (error) {
    const kept = await (await caches.open(own)).match(page);
    if (!kept) throw error;
    return kept;
  }
}

async function found(request: Request): Promise<Response> {
  return (await (await caches.open(own)).match(request)) ?? fetch(request);
}
