// Numbers as the page prints them: six digits, in the unit with a prefix that suits them.

Carom.quantities = (() => {
  const DIGITS = 6;
  const [FEWEST, MOST] = [-4, 5]; // decades in which numbers are written without "e"

  const exponent = (value, digits) => Number(value.toExponential(digits - 1).split("e")[1]);

  // The power of ten of the unit that suits a value, and its name.
  function suited(value, unit, digits = DIGITS) {
    const units = Carom.config.prefixes[unit] || [[0, unit]];
    const size = Math.abs(value);
    if (!(size > 0 && size < Infinity)) return [0, unit];
    const decades = units.map((each) => exponent(size, digits) - each[0]);
    for (let i = units.length - 1; i >= 0; i--) if (decades[i] >= 0 && decades[i] <= MOST) return units[i];
    return units.find((_, i) => decades[i] >= FEWEST && decades[i] < 0) || [0, unit];
  }

  // Without zeros at the end, and with "e" where it is long.
  function plain(value, places) {
    if (value === 0) return "0";
    const power = exponent(value, places);
    if (power < FEWEST || power >= places) {
      const [mantissa, e] = value.toExponential(places - 1).split("e");
      const size = String(Math.abs(Number(e))).padStart(2, "0");
      return `${Number(mantissa)}e${Number(e) < 0 ? "-" : "+"}${size}`;
    }
    return String(Number(value.toPrecision(places)));
  }

  function text(value, power, digits) {
    const [mantissa, e] = value.toExponential(digits - 1).split("e");
    const decades = Number(e) - power;
    const places = decades <= MOST ? Math.max(digits, decades + 1) : digits;
    return plain(Number(`${mantissa}e${decades}`), places);
  }

  // A value and its unit, in words where there is none.
  function printed(value, unit, digits = DIGITS) {
    if (Number.isNaN(value)) return { value: "none: it was zero before", unit: "" };
    if (!Number.isFinite(value)) return { value: "none: it slides freely", unit: "" };
    const [number, name] = unit === "rad" ? [(value * 180) / Math.PI, "deg"] : [value, unit];
    const [power, shown] = suited(number, name, digits);
    return { value: text(number, power, digits), unit: shown === "1" ? "" : shown };
  }

  // By what to multiply a value, and the unit that it is in then.
  function prefixed(value, unit) {
    const [power, name] = suited(value, unit);
    return [Number(`1e${-power}`), name];
  }

  return { printed, prefixed, plain };
})();
