async ([query, shares]) => {
  const { scene } = await Carom.reading.answer(query);
  const made = Carom.scene.of(scene);
  return shares.map(share => Carom.sentence.of(made, share));
}
