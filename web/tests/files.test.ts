// Checksums and numbers as Python has them. The expected values are Python's own: hashlib.blake2b,
// repr and json.dumps of CPython 3.11.

import { expect, test } from "vitest";
import { blake2b } from "../src/out/blake2b";
import { dumps, repr, Whole } from "../src/out/python_text";
import { SvgSurface } from "../src/view/svg";

test("BLAKE2b of RFC 7693, appendix A, with 64 bytes", () => {
  expect(blake2b(new TextEncoder().encode("abc"), 64)).toBe(
    "ba80a53f981c4d0d6a2797b69f12f6e94c212f14685ac4b74b12bb6fdbffa2d17d87c5392aab792dc252d5de4533cc9518d38aa8dbf1925ab92386edd4009923",
  );
});

// [hashlib.blake2b(bytes(i % 251 for i in range(n)), digest_size=16).hexdigest() for n in …]
test.each([
  [0, "cae66941d9efbd404e4d88758ea67670"],
  [1, "7025e075d5e2f6cde3cc051a31f07660"],
  [127, "28b1296c7d4807883de6ee4ec04dcc0a"],
  [128, "a74787004ef589e31149183900d0294a"],
  [129, "aaf1b0371f6d4ee49ee4fb5ddd9c49ef"],
  [256, "1142c504dcd26338b7cbcf41424540d0"],
  [1000, "bca120dfd89cd95d82898473a5b01c90"],
])("BLAKE2b of %d bytes", (count, expected) => {
  expect(blake2b(Uint8Array.from({ length: count }, (_, i) => i % 251))).toBe(expected);
});

test.each([
  [0, "0.0"],
  [-0, "-0.0"],
  [1, "1.0"],
  [-2.5, "-2.5"],
  [0.1, "0.1"],
  [1e-4, "0.0001"],
  [1e-5, "1e-05"],
  [1.5e-5, "1.5e-05"],
  [123456789012345680, "1.2345678901234568e+17"],
  [1e16, "1e+16"],
  [1e15, "1000000000000000.0"],
  [5e-324, "5e-324"],
  [1.7976931348623157e308, "1.7976931348623157e+308"],
  [2.0943951023931953, "2.0943951023931953"],
  [Number.NaN, "nan"],
])("repr(%d)", (value, expected) => {
  expect(repr(value)).toBe(expected);
});

test("json.dumps", () => {
  const data = { a: [1, new Whole(2), null, "ñ\n"], b: { c: true, d: -1e-7 } };
  expect(dumps(data)).toBe('{"a": [1.0, 2, null, "\\u00f1\\n"], "b": {"c": true, "d": -1e-07}}');
});

test("a drawing as SVG: balanced groups, escaped text", () => {
  const surface = new SvgSurface(100, 50);
  surface.save();
  surface.beginPath();
  surface.rect(0, 0, 10, 10);
  surface.clip();
  surface.moveTo(1, 2);
  surface.lineTo(3, 4);
  surface.stroke();
  surface.restore();
  surface.fillText("a < b & c", 5, 5);
  const text = surface.text('"x"');
  expect(text.match(/<g /g)?.length).toBe(text.match(/<\/g>/g)?.length);
  expect(text).toContain("a &lt; b &amp; c");
  expect(text).toContain("<title>&quot;x&quot;</title>");
});
