// Degrees to radians, correctly rounded but for rare ties, as `pendula.degrees` does it: a typed 120°
// is the double that Python takes for "120deg". Products with their rounding error by Dekker,
// Numer. Math. 18 (1971) 224, Section 5.

const PI_REST = 1.2246467991473532e-16; // π less the double nearest to it
const SPLITTER = 2 ** 27 + 1;

/** The two halves of a double, of 26 bits each. */
function halves(value: number): [number, number] {
  const scaled = SPLITTER * value;
  const high = scaled - (scaled - value);
  return [high, value - high];
}

/** A product, and what its rounding took away. */
function product(a: number, b: number): [number, number] {
  const value = a * b;
  const [[a1, a2], [b1, b2]] = [halves(a), halves(b)];
  return [value, a2 * b2 - (value - a1 * b1 - a2 * b1 - a1 * b2)];
}

/** An angle in radians. */
export function radians(degrees: number): number {
  const [turned, rest] = product(degrees, Math.PI);
  const quotient = turned / 180;
  const [back, backRest] = product(quotient, 180);
  return quotient + (turned - back - backRest + rest + degrees * PI_REST) / 180;
}
