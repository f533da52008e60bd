// The kernels of the library, compiled for browsers: their memory, and how they are called.

Carom.kernels = (() => {
  const { code, arrays } = Carom.wasm;
  const PAGE = 65536; // bytes by which the memory grows
  const STACK = 1 << 20; // bytes below, of constants and the stack
  const KINDS = { f8: Float64Array, i8: BigInt64Array, i1: Int8Array };
  const FUNCTIONS = ["pow", "asin", "acos", "atan", "atan2", "sin", "cos", "exp", "expm1", "log", "log1p", "hypot", "cbrt"];
  const MOST_WORDS = 128; // of the arguments of a function
  const memory = new WebAssembly.Memory({ initial: 2 + STACK / PAGE });
  let top = STACK;
  const lasting = {}; // the arrays that functions work on, by names of the library
  let exported = null;
  const ready = load();

  async function load() {
    const bytes = Uint8Array.from(atob(code), (letter) => letter.charCodeAt(0));
    const stack = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const math = Object.fromEntries(FUNCTIONS.map((name) => [name, Math[name]]));
    const env = { __linear_memory: memory, __stack_pointer: stack, ...math };
    exported = (await WebAssembly.instantiate(bytes, { env })).instance.exports;
    for (const [name, all] of Object.entries(arrays)) lasting[name] = all.map(([kind, shape]) => array(shape, kind));
  }

  // An array of so many numbers of a kind, all zero.
  function array(shape, kind = "f8") {
    const size = shape.reduce((product, length) => product * length, 1);
    const made = { at: top, shape, size, kind };
    top = 16 * Math.ceil((top + size * KINDS[kind].BYTES_PER_ELEMENT) / 16);
    const lacking = top - memory.buffer.byteLength;
    if (lacking > 0) memory.grow(Math.ceil(lacking / PAGE));
    numbers(made).fill(kind === "i8" ? 0n : 0);
    return made;
  }

  // The numbers of an array, to read and write until another one is made.
  const numbers = ({ at, size, kind }) => new KINDS[kind](memory.buffer, at, size);

  // The first rows of an array, as an array.
  function rows(whole, count) {
    const shape = [count, ...whole.shape.slice(1)];
    return { ...whole, shape, size: shape.reduce((product, length) => product * length, 1) };
  }

  function filled(values) {
    const made = array([values.length]);
    numbers(made).set(values);
    return made;
  }

  // Do something with arrays that are no longer there afterwards.
  function within(work) {
    const before = top;
    try {
      return work();
    } finally {
      top = before;
    }
  }

  // Call a function with arrays, numbers, and whole numbers as BigInt; results are read from the
  // words behind the arguments, as the first of a kind.
  function call(name, args, result = "f8") {
    const words = array([MOST_WORDS]);
    const floats = numbers(words);
    const whole = numbers({ ...words, kind: "i8" });
    let place = 0;
    for (const each of args.flat()) {
      if (typeof each === "number") floats[place++] = each;
      else if (typeof each === "bigint") whole[place++] = each;
      else for (const value of [each.at, ...each.shape]) whole[place++] = BigInt(value);
    }
    if (exported[name](words.at)) throw Error(`${name} has failed`);
    return Array.from(numbers({ ...words, kind: result }).subarray(place), Number);
  }

  return { ready, array, numbers, rows, filled, lasting, within, call };
})();
