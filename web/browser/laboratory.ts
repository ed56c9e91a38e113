// The built page in the system's Chromium, on a server that sends the policy of pendula's own.

import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { type Browser, type BrowserContextOptions, chromium, type Page } from "playwright-core";
import { serve } from "./serve";

export const BUILT = fileURLToPath(new URL("../../src/pendula/lab/static", import.meta.url));
export const PYTHON =
  process.env.PENDULA_PYTHON ?? fileURLToPath(new URL("../../.venv/bin/python", import.meta.url));
const CHROMIUM = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const found = process.env.PENDULA_CHROMIUM ?? CHROMIUM.find(existsSync);

/** Whether there is a browser; where CI is set there has to be one. */
export const hasChromium = found !== undefined || process.env.CI !== undefined;

export interface Laboratory {
  url: string;
  /** `before` runs in the page before its own scripts. */
  open: (hash?: string, options?: BrowserContextOptions, before?: () => void) => Promise<Opened>;
  close: () => Promise<void>;
}

/** A page, with what it said to the console and asked of any server. */
export interface Opened {
  page: Page;
  said: string[];
  asked: string[];
}

/** Starts the browser and the server. */
export async function laboratory(): Promise<Laboratory> {
  const { url, close } = await serve(BUILT);
  const browser: Browser = await chromium.launch({ executablePath: found, args: ["--no-sandbox"] });
  const open: Laboratory["open"] = async (hash = "", options = {}, before = undefined) => {
    const context = await browser.newContext({
      viewport: { width: 1280, height: 900 },
      serviceWorkers: "block", // they would fetch the page once more for each test
      ...options,
    });
    const page = await context.newPage();
    if (before) await page.addInitScript(before);
    const [said, asked]: [string[], string[]] = [[], []];
    page.on("console", (message) => {
      if (!message.text().includes("blocked by Playwright")) {
        said.push(`${message.type()}: ${message.text()}`);
      }
    });
    page.on("pageerror", (error) => said.push(`error: ${error.message}`));
    page.on("request", (request) => asked.push(request.url()));
    await page.goto(/^\w+:/.test(hash) ? hash : url + hash);
    return { page, said, asked };
  };
  return {
    url,
    open,
    close: async () => {
      await browser.close();
      close();
    },
  };
}

export const STILL: BrowserContextOptions = { reducedMotion: "reduce" };
export const RODS =
  "system=double&form=rods&m1=1&m2=1&l1=1&l2=1&gravity=9.80665&state=2.0943951023931953,-0.17453292519943295,0,0";

/** Waits until the run is at its end and the horizon of trust is known. */
export async function computed(page: Page): Promise<void> {
  await page.waitForFunction(() =>
    /[0-9]|right|correcta|determin/i.test(
      document.querySelector(".readings p:last-child")?.textContent ?? "",
    ),
  );
}
