// What the page is made from: fields, materials, laws, symbols, examples; written once, in Python.
window.Carom = {};

Carom.config = JSON.parse(document.getElementById("config").textContent);
