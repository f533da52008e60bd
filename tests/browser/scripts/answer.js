async queries => Promise.all(queries.map(query => Carom.reading.answer(query)
  .then(answer => ({answer}), refusal => ({refusal}))))
