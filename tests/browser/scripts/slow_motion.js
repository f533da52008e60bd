() => {
  const clock = Carom.clock;
  clock.borders([0.4, 0.8]);
  const run = slow => {
    clock.slow(slow);
    const times = [clock.FIRST];
    while (times.at(-1) < clock.LAST) times.push(clock.after(times.at(-1), 1 / 60));
    return times;
  };
  const found = { usual: run(false), slow: run(true) };
  clock.slow(false);
  return found;
}
