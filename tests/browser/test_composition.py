"""The page as a picture at four widths, light and dark: what is in view, fits, is told apart."""

import itertools

import pytest

pytestmark = pytest.mark.browser
WIDTHS = (400, 1024, 1440, 1920)
THEMES = ("light", "dark")
CHARTS = ("rebounds", "forces", "energies")
STATES = {
    "as it opens": "",
    "three laws": "angle=25&friction=0.25&law=mindlin&law=YADE+Mindlin&law=Walton+%26+Braun",
    "numbers": "given=numbers&psi=-3.5&chi=0.7",
    "losses, beside": "restitution=0.7&angle=12&beside=angle%3D60",
    "a story": "preset=superball",
}
EMPTIEST = 1 / 3  # of a card
ABOUT = 28  # pixels around what a card holds that are not empty
STAGES = """() => [...document.querySelectorAll('#film canvas')]
  .filter(each => each.checkVisibility())
  .map(each => { const box = each.getBoundingClientRect();
    return [box.left, box.top, innerWidth - box.right, innerHeight - box.bottom]; }).flat()"""
EMPTY = """about => [...document.querySelectorAll('.carom-card, .carom-cell')]
  .filter(card => card.checkVisibility()).map(card => {
    const box = card.getBoundingClientRect();
    const boxes = [];
    const walk = document.createTreeWalker(card, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) { if (!walk.currentNode.textContent.trim()) continue;
      const range = document.createRange(); range.selectNodeContents(walk.currentNode);
      boxes.push(...range.getClientRects()); }
    card.querySelectorAll('canvas, .main-svg, tr, input, select, button, .carom-drop')
      .forEach(each => each.checkVisibility() && boxes.push(each.getBoundingClientRect()));
    const [step, count] = [8, { all: 0, empty: 0 }];
    for (let x = box.left + step / 2; x < box.right; x += step)
      for (let y = box.top + step / 2; y < box.bottom; y += step) {
        count.all++;
        if (!boxes.some(b => x > b.left - about && x < b.right + about
          && y > b.top - about && y < b.bottom + about)) count.empty++; }
    return { card: card.id || card.innerText.slice(0, 20), empty: count.empty / count.all }; })"""
WORDS = """() => {
  const clip = at => { const box = { left: 0, top: 0, right: innerWidth, bottom: innerHeight };
    for (let e = at; e && e !== document.body; e = e.parentElement) {
      const style = getComputedStyle(e);
      if (!/auto|scroll|hidden/.test(style.overflowX + style.overflowY)) continue;
      const b = e.getBoundingClientRect();
      box.left = Math.max(box.left, b.left); box.right = Math.min(box.right, b.right);
      box.top = Math.max(box.top, b.top); box.bottom = Math.min(box.bottom, b.bottom); }
    return box; };
  const found = [];
  const add = (at, text, r) => { const c = clip(at);
    found.push({ text, box: [r.left, r.top, r.right, r.bottom],
      seen: r.left > c.left - 1 && r.right < c.right + 1
        && r.top > c.top - 1 && r.bottom < c.bottom + 1,
      aside: r.left < c.left - 1.5 || r.right > c.right + 1.5 }); };
  const walk = document.createTreeWalker(document.getElementById('page'), NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode, at = node.parentElement;
    if (!node.textContent.trim()
      || !at.checkVisibility({ visibilityProperty: true, opacityProperty: true })
      || at.closest('select, .hoverlayer, pre, sub, sup, #tip')) continue;
    const around = [at, at.closest('h2') || at];
    if (around.some(each => getComputedStyle(each).clipPath !== 'none')) continue;
    const range = document.createRange(); range.selectNodeContents(node);
    for (const r of range.getClientRects()) if (r.width > 1) add(at, node.textContent.trim(), r); }
  return found; }"""
CANVAS_WORDS = """() => {
  const found = [], fill = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
    const size = this.measureText(text), dense = devicePixelRatio;
    const at = this.getTransform().transformPoint({ x, y });
    found.push({ canvas: drawing, still: !this.canvas.isConnected, text,
      box: [at.x / dense - size.actualBoundingBoxLeft, at.y / dense - size.actualBoundingBoxAscent,
        at.x / dense + size.actualBoundingBoxRight, at.y / dense + size.actualBoundingBoxDescent],
      room: [this.canvas.width / dense, this.canvas.height / dense] });
    return fill.apply(this, arguments); };
  const drawn = [];
  let drawing = '';
  // nothing is kept of these scenes
  const scenes = Carom.page.answers().map(each => each && Carom.scene.of(each.scene));
  for (const time of [-0.4, 0.02, 0.2, 0.35, 0.5, 0.7, 0.9, 0.99, 1.4]) {
    found.length = 0;
    scenes.forEach((scene, row) => scene && ['stage', 'patch'].forEach(name => {
      drawing = row ? `${name}-beside` : name;
      Carom[name].draw(document.getElementById(drawing), scene, time); }));
    drawn.push(...found.map(each => ({ ...each, time }))); }
  CanvasRenderingContext2D.prototype.fillText = fill;
  return drawn; }"""


def apart(one, other, least=1.0):
    """Whether two boxes overlap by less than some pixels."""
    width = min(one[2], other[2]) - max(one[0], other[0])
    height = min(one[3], other[3]) - max(one[1], other[1])
    return width < least or height < least + 1.0


def overlapping(words, least=1.0):
    """Return pairs of words that are drawn one over the other."""
    pairs = itertools.combinations(words, 2)
    return [
        (a["text"], b["text"])
        for a, b in pairs
        if a["box"] != b["box"] and not apart(a["box"], b["box"], least)
    ]


def check_words(seen):
    words = seen.page.evaluate(WORDS)
    assert len(words) > 30
    assert [each["text"] for each in words if each["aside"]] == []
    assert overlapping([each for each in words if each["seen"]], 2.0) == []


def check_pictures(seen):
    words = seen.page.evaluate(CANVAS_WORDS)
    cut = [
        (each["canvas"], each["time"], each["text"])
        for each in words
        if min(each["box"][:2]) < -1
        or each["box"][2] > each["room"][0] + 1
        or each["box"][3] > each["room"][1] + 1
    ]
    assert cut == []
    for canvas, time in {(each["canvas"], each["time"]) for each in words}:
        there = [w for w in words if w["canvas"] == canvas and (w["still"] or w["time"] == time)]
        once = {(w["text"], *w["box"]): w for w in there}.values()
        assert overlapping(once) == []


def check_cards(seen):
    empty = {each["card"]: each["empty"] for each in seen.page.evaluate(EMPTY, ABOUT)}
    assert len(empty) >= 6
    assert {card: share for card, share in empty.items() if share > EMPTIEST} == {}
    charts = [seen.page.locator(f"#{name}").bounding_box() for name in CHARTS]
    heights = [box["height"] for box in charts]
    assert max(heights) - min(heights) < 1
    assert min(heights) > 200


def check_sliders(seen):
    """The pictures stay in view while a slider is moved, and do not hide it."""
    sliders = seen.page.locator("#fields input[type=range]").all()
    moved = [slider for slider in sliders if slider.is_visible()]
    assert len(moved) >= 4
    for slider in moved:
        slider.scroll_into_view_if_needed()
        slider.press("ArrowRight")
        assert min(seen.page.evaluate(STAGES)) >= 0
        box, film = slider.bounding_box(), seen.page.locator("#film").bounding_box()
        if box["x"] < film["x"] + film["width"] and film["x"] < box["x"] + box["width"]:
            assert box["y"] >= film["y"] + film["height"]


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("width", WIDTHS)
def test_the_page_is_composed(visit, width, state):
    seen = visit(f"?{STATES[state]}", width=width)
    seen.until(lambda: seen.traces("energies"))
    for theme in THEMES:
        seen.page.evaluate(f"Carom.theme.choose('{theme}')")
        seen.page.wait_for_timeout(300)
        check_words(seen)
        check_pictures(seen)
        check_cards(seen)
    check_sliders(seen)


@pytest.mark.parametrize("panel", ["Measurements", "Files", "Python"])
@pytest.mark.parametrize("width", WIDTHS)
def test_panels_are_composed(visit, width, panel):
    seen = visit(f"?tab={panel}&data=kharaz2001", width=width)
    place = {"Measurements": "#fit .main-svg", "Files": "#files a", "Python": "#code"}[panel]
    seen.until(lambda: seen.page.locator(place).first.is_visible())
    seen.until(lambda: panel != "Python" or "carom" in seen.page.inner_text("#code"))
    seen.page.wait_for_timeout(300)
    check_words(seen)
    empty = {each["card"]: each["empty"] for each in seen.page.evaluate(EMPTY, ABOUT)}
    assert {card: share for card, share in empty.items() if share > EMPTIEST} == {}
