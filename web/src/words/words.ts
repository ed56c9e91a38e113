// Every word of the page, in English and Spanish, side by side: the one home of the words.

import { controls } from "./controls";
import { out } from "./out";
import { refusals } from "./refusals";
import { views } from "./views";

/** A sentence in English and in Spanish; what it names stands in braces. */
export type Row = readonly [english: string, spanish: string];

export const words = { ...controls, ...views, ...out, ...refusals } as const;
export type Key = keyof typeof words;
export type Values = Readonly<Record<string, string | number>>;
