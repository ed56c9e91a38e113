// Two builds of the same page: static files with relative paths and, in the mode "one-file", a single
// HTML file that works from a disk and in a sandboxed frame.
import { createHash } from "node:crypto";
import { fileURLToPath } from "node:url";
import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** Puts scripts and styles into the HTML, which becomes the only file. */
function inOneFile(): Plugin {
  return {
    name: "in-one-file",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("no index.html was built");
      let html = String(page.source);
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        const text = part.type === "chunk" ? part.code : String(part.source);
        const [tag, put] = name.endsWith(".css")
          ? [/<link rel="stylesheet"[^>]*>/, `<style>${text}</style>`]
          : [/<script type="module"[^>]*><\/script>/, inlineScript(text)];
        html = html.replace(tag, () => put);
        delete bundle[name];
      }
      page.source = html;
      page.fileName = "lab.html";
    },
  };
}

function inlineScript(code: string): string {
  return `<script type="module">${code.replaceAll("</script", "<\\/script")}</script>`;
}

const KEEPER = "service_worker"; // its address must not change, so its name has no hash

const twoEntries = {
  input: { index: here("index.html"), [KEEPER]: here(`src/offline/${KEEPER}.ts`) },
  output: {
    entryFileNames: ({ name }: { name: string }) =>
      name === KEEPER ? "[name].js" : "assets/[name]-[hash].js",
  },
};

/** Tells the service worker which files the page has, and which build they are of. */
function keptOffline(): Plugin {
  return {
    name: "kept-offline",
    enforce: "post",
    generateBundle(_, bundle) {
      const keeper = bundle[`${KEEPER}.js`];
      if (keeper?.type !== "chunk") throw new Error("no service worker was built");
      const parts = Object.entries(bundle).filter(([, part]) => part !== keeper);
      const hash = createHash("sha256").update(keeper.code);
      for (const [name, part] of parts.sort(([a], [b]) => (a < b ? -1 : 1))) {
        hash.update(name).update(part.type === "chunk" ? part.code : part.source);
      }
      const files = parts.map(([name]) => name).filter((name) => name !== "index.html");
      keeper.code = keeper.code
        .replaceAll("BUILD_FILES", JSON.stringify(files))
        .replaceAll("BUILD_HASH", JSON.stringify(hash.digest("hex").slice(0, 16)));
    },
  };
}

export default defineConfig(({ mode }) => {
  const alone = mode === "one-file";
  return {
    base: "./",
    assetsInclude: ["**/*.wasm"],
    resolve: { alias: { "#source": here(`src/source/${alone ? "one_file" : "files"}.ts`) } },
    plugins: [alone ? inOneFile() : keptOffline()],
    build: {
      outDir: here("../src/pendula/lab/static"),
      emptyOutDir: !alone,
      target: "es2022",
      assetsInlineLimit: 0,
      modulePreload: { polyfill: false },
      reportCompressedSize: false,
      rolldownOptions: alone ? {} : twoEntries,
    },
    // From a disk browsers start no worker that is a module.
    worker: { format: alone ? "iife" : "es" },
    test: { include: ["tests/*.test.ts"] },
  };
});
