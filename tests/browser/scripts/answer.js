async queries => Promise.all(queries.map(query => Carom.source.answer(query)
  .then(answer => ({answer}), refusal => ({refusal}))))
