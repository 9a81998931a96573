const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

const superscript = (power) =>
  (power < 0 ? "⁻" : "") +
  [...String(Math.abs(power))].map((digit) => superscripts[digit]).join("");

/** A number for reading: 0.0246, 1.2 × 10⁻⁷, −3; "–" when there is none. */
export function number(value, digits = 3) {
  if (value == null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(value)));
  if (power < -3 || power > 6) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${mantissa} × 10${superscript(Number(exponent))}`.replace("-", "−");
  }
  const rounded = Number(value.toPrecision(digits));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(rounded))));
  return rounded.toFixed(decimals).replace("-", "−");
}

/** As short as it can be said: 20, 9.58, −10. */
export const short = (value) => String(Number(value.toPrecision(6))).replace("-", "−");

export const whole = (value) =>
  value == null ? "–" : value.toLocaleString("en").replace("-", "−");

/** A relative difference in percent, with its sign. */
export function percent(value, digits = 1) {
  if (value == null || !Number.isFinite(value)) return "–";
  const text = (100 * value).toFixed(digits);
  return `${value > 0 ? "+" : ""}${text}`.replace("-", "−") + " %";
}

export function seconds(value) {
  if (value == null) return "–";
  if (value < 60) return `${number(value, 3)} s`;
  const s = Math.round(value);
  const minutes = Math.floor(s / 60) % 60,
    hours = Math.floor(s / 3600);
  const two = (n) => String(n).padStart(2, "0");
  return hours > 0 ? `${hours}:${two(minutes)}:${two(s % 60)} h` : `${minutes}:${two(s % 60)} min`;
}
