// Files that are no text tables: the page does not read them, pendula in Python does.

import { Refused } from "../words/refused";

const ENDINGS = /\.(mat|xlsx?|ods|trk|trz|zip|parquet|nc)$/i;
const BEGINNINGS = [
  "PK\x03\x04", // archives, newer spreadsheets among them
  "\xd0\xcf\x11\xe0", // older spreadsheets
  "\x89HDF", // HDF5, which newer NetCDF and MATLAB files are
  "CDF", // older NetCDF
  "MATLAB",
  "PAR1",
  "<?xml", // Tracker's files
];

/** Refuses what is no text table, by its name or its first bytes, with the command that reads it. */
export function checkText(name: string, bytes: Uint8Array): void {
  const start = String.fromCharCode(...bytes.subarray(0, 8));
  if (!ENDINGS.test(name) && !BEGINNINGS.some((each) => start.startsWith(each))) return;
  throw new Refused("data_format", { command: `pendula fit ${quoted(name)}` });
}

/** A word of a shell's command. */
function quoted(name: string): string {
  return /^[\w.+-]+$/.test(name) ? name : `'${name.replaceAll("'", "'\\''")}'`;
}
