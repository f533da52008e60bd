name => {
  Carom.clock[name]();
  const now = Carom.clock.now();
  return [now, Carom.clock.isPlaying(), Carom.page.scenes[0].at(Number(now.toFixed(6))).phase];
}
