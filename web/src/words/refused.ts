// What a person asked for and cannot have: one line, in the page's language, by a key of the words.

import type { Key, Values } from "./words";

/** Something refused: which sentence says so, and what it names. */
export class Refused extends Error {
  /**
   * @param key of the sentence.
   * @param values that it names in braces.
   */
  constructor(
    readonly key: Key,
    readonly values: Values = {},
  ) {
    super(key);
  }
}
