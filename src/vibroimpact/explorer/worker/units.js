// Numbers with units, read and written as `model/units.py` does; sizes of units come from Python.

export class Refused extends Error {
  constructor(words, path = null) {
    super(words);
    this.path = path;
  }
}

const NUMBER = /^[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?/;
const [LEAST, MOST] = [1e-5, 1e9];
// Nobody means frequencies beyond these (Hz).
const [SLOWEST, FASTEST] = [1e-100, 1e100];

function normal(unit) {
  return unit.replaceAll("**", "^").replace(/[·*]/g, " ").replaceAll("^2", "²").replaceAll("^3", "³").replace("μ", "µ").replace(/s2$/, "s²").replace(/\s+/g, " ").trim();
}

// A value in SI units: `accepts` has the quantity's name, its bounds, and words for what is accepted.
export function read(value, accepts, quantities, path, limits) {
  const refuse = (why) => {
    throw new Refused(`${path}: ${typeof value === "string" ? `'${value}'` : value} ${why}; use ${accepts.accepted}`, path);
  };
  let number = value;
  if (typeof value === "string") {
    const text = value.replaceAll("−", "-").replace(/\s+/g, " ").trim();
    if (!text) refuse("is empty");
    const leading = NUMBER.exec(text);
    if (!leading) refuse("does not start with a number");
    const unit = normal(text.slice(leading[0].length));
    if (unit.startsWith(",")) refuse("has a comma; write a decimal point");
    const size = unit ? quantities[accepts.quantity].units[unit] : 1;
    if (size === undefined) refuse(`has a unit, '${unit}', that is unknown here or of another quantity`);
    // As a decimal number: a product of 7.5 and 0.001 would be rounded twice.
    const exponent = Math.log10(size);
    number = Number.isInteger(exponent) && !/e/i.test(leading[0]) ? Number(`${leading[0]}e${exponent}`) : Number(leading[0]) * size;
  }
  if (typeof number !== "number" || Number.isNaN(number)) refuse("is not a number");
  if (!Number.isFinite(number)) refuse("is not finite");
  const { above, minimum, maximum } = accepts;
  const bound = (end) => (end ? plain(end) : "0");
  if (above != null && !(number > above)) refuse(`is not greater than ${bound(above)}`);
  if (accepts.quantity === "frequency" && !(number >= SLOWEST && number <= FASTEST)) refuse("is no frequency of a motion");
  if (minimum != null && !(number >= minimum)) refuse(`is less than ${bound(minimum)}`);
  if (maximum != null && !(number <= maximum)) refuse(`is greater than ${bound(maximum)}`);
  if (Math.abs(number) > limits.most || (above === 0 && number < limits.least)) refuse("is too large or too small");
  return number + 0;
}

export function plain(value, digits = 6) {
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  const power = size ? Number(rounded.toExponential().split("e")[1]) : 0;
  if ((power < -4 || power >= digits) && !(Math.abs(value) >= LEAST && Math.abs(value) < MOST)) {
    const [mantissa, exponent] = rounded.toExponential().split("e");
    return `${mantissa}e${exponent[0]}${exponent.slice(1).padStart(2, "0")}`;
  }
  return size ? String(rounded) : "0";
}

// The unit in which the largest of some values is written: [least, size, symbol].
export function fitting(values, { scales }) {
  const largest = Math.max(0, ...values.filter(Number.isFinite).map(Math.abs));
  if (largest === 0) return scales.find((scale) => scale[1] === 1) ?? scales[0];
  return scales.find((scale) => largest >= scale[0]);
}

export function pretty(value, quantity, digits = 6) {
  const [, size, symbol] = fitting([Number(value.toPrecision(digits))], quantity);
  return `${plain(value / size, digits)} ${symbol}`.trim();
}

// What JSON can hold, with so many digits.
export const one = (value, digits = 5) => (Number.isFinite(value) ? Number(value.toPrecision(digits)) : null);
export const short = (values, digits = 5) => Array.from(values, (value) => one(value, digits));
