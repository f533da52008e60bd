// The balls as they meet and part: motion magnified, contact flattened, path and speeds.

Carom.stage = (() => {
  const { canvas, contact } = Carom;
  const SHORT = 0.08; // arrows that are not drawn, in radii
  const FORCE = 1.1; // the largest tangential force, likewise
  const EDGE = 8; // pixels beside the words below
  const LINE = 17; // pixels of a line of them
  const NOTE = 12;
  const drawings = new WeakMap(); // what was drawn last on a canvas
  const ROOMY = 220; // pixels of height from which on a long note has a line more
  const color = (name) => Carom.theme.color(name);

  function enter(pen, seen) {
    pen.save();
    pen.transform(seen.unit, 0, 0, -seen.unit, seen.x, seen.y);
  }

  // A ball: sectors and a mark on its rim tell how far it has turned.
  function drawBall(pen, seen, body, outline, name) {
    enter(pen, seen);
    pen.lineWidth = 1.5 / seen.unit;
    pen.fillStyle = color(`${name}-light`);
    pen.fill(outline);
    pen.save();
    pen.clip(outline);
    pen.translate(body.x, body.y);
    pen.rotate(body.turn);
    pen.fillStyle = color(`${name}-dark`);
    const reach = 1.01 * body.radius;
    for (const start of [0.25, 1.25]) {
      pen.beginPath();
      pen.moveTo(0, 0);
      pen.arc(0, 0, reach, start * Math.PI, (start + 0.5) * Math.PI);
      pen.fill();
    }
    pen.strokeStyle = color("ink");
    pen.lineWidth = 2 / seen.unit;
    pen.beginPath();
    pen.moveTo(0, 0.55 * body.radius);
    pen.lineTo(0, 0.97 * body.radius);
    pen.stroke();
    pen.restore();
    pen.strokeStyle = color("ink");
    pen.stroke(outline);
    pen.restore();
  }

  // A plane or a block with a hollow: all that is below its surface, of a plate as far as it is thick.
  function drawGround(pen, seen, body) {
    const left = -seen.x / seen.unit;
    const right = (seen.width - seen.x) / seen.unit;
    const low = (seen.y - seen.height) / seen.unit;
    enter(pen, seen);
    pen.beginPath();
    if (body.kind === "cup") {
      const rim = body.y - 0.15 * body.radius;
      const reach = Math.sqrt(body.radius ** 2 - (body.y - rim) ** 2);
      const angle = Math.asin(0.15);
      pen.moveTo(left, rim);
      pen.lineTo(body.x - reach, rim);
      pen.arc(body.x, body.y, body.radius, Math.PI + angle, 2 * Math.PI - angle);
      pen.lineTo(right, rim);
    } else {
      pen.moveTo(left, body.y);
      pen.lineTo(right, body.y);
    }
    pen.lineWidth = 1.5 / seen.unit;
    pen.strokeStyle = color("ink");
    pen.stroke();
    const base = body.kind === "plate" ? body.y - body.radius : low;
    pen.lineTo(right, base);
    pen.lineTo(left, base);
    pen.closePath();
    pen.fillStyle = color("ground");
    pen.fill();
    if (body.kind === "plate") pen.stroke();
    pen.restore();
  }

  // The whole path of the ball, and the velocities at its ends, that of the nearer end strong.
  // Returns the boxes of their names.
  function drawMotion(pen, seen, [ball], strong) {
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, seen.width, seen.height);
    pen.clip();
    pen.beginPath();
    ball.x.forEach((x, i) => pen[i ? "lineTo" : "moveTo"](...seen.at([x, ball.y[i]])));
    pen.setLineDash([3, 4]);
    pen.lineWidth = 1.5;
    pen.strokeStyle = color("accent");
    pen.stroke();
    pen.setLineDash([]);
    const taken = Carom.hand.throws(); // its arrow is the one in the hand
    const shown = seen.arrows.filter(({ length, when, first }) => length >= SHORT && !(taken && first && when === "before"));
    const later = shown.filter(({ when }) => when !== strong);
    const all = [...later, ...shown.filter(({ when }) => when === strong)];
    for (const { when, from, to } of all) {
      pen.globalAlpha = when === strong ? 1 : 0.45;
      canvas.arrows(pen, [[...seen.at(from), ...seen.at(to)]], color(when), 3);
    }
    const boxes = [];
    pen.restore();
    for (const { when, tip, first } of all.reverse()) {
      if (first) canvas.name(pen, when, seen.at(tip), boxes, seen);
    }
    return boxes;
  }

  // The part of the path that the ball has gone.
  function drawGone(pen, seen, { time, bodies: [ball] }, now, share) {
    pen.beginPath();
    pen.moveTo(...seen.at([ball.x[0], ball.y[0]]));
    for (let i = 1; i < time.length && time[i] <= share; i++) {
      pen.lineTo(...seen.at([ball.x[i], ball.y[i]]));
    }
    const centre = seen.at([now.x, now.y]);
    pen.lineTo(...centre);
    pen.lineWidth = 2.5;
    pen.strokeStyle = pen.fillStyle = color("accent");
    pen.stroke();
    pen.beginPath();
    pen.arc(...centre, 4, 0, 2 * Math.PI);
    pen.fill();
  }

  // The line of contact: what sticks in the middle, what slips at both ends.
  function drawContact(pen, seen, touch, now) {
    const share = now.contact > 0 ? now.stick / now.contact : 0;
    const stretch = (from, to, kind, width) => {
      if (to <= from) return;
      pen.beginPath();
      for (let i = 0; i <= 12; i++) {
        pen[i ? "lineTo" : "moveTo"](...seen.at(touch.at(from + ((to - from) * i) / 12)));
      }
      pen.strokeStyle = canvas.phaseColor(kind);
      pen.lineWidth = width;
      pen.lineCap = "butt";
      pen.stroke();
    };
    if (now.sign) stretch(-1, -share, now.kind, 5);
    if (now.sign) stretch(share, 1, now.kind, 5);
    stretch(-share, share, "stick", 8);
  }

  // Friction on the first body, against the traction on the second.
  function drawForce(pen, seen, touch, now, boxes) {
    const length = -now.force * FORCE;
    if (Math.abs(length) < SHORT) return;
    const [x, y] = touch.at(0);
    const [dx, dy] = touch.along;
    const lift = Math.max(0.2, 9 / seen.unit);
    const from = [x - dy * lift, y + dx * lift];
    const to = [from[0] + dx * length, from[1] + dy * length];
    canvas.arrows(pen, [[...seen.at(from), ...seen.at(to)]], color("force"), 3, color("panel"));
    const order = length < 0 ? "left" : "right";
    canvas.name(pen, "friction", seen.at(to), [...boxes], seen, { order });
  }

  // How the words below are set: key and note side by side, or one above the other.
  function footOf(pen, scene, width, height) {
    const note = scene.data.stage.caption || "";
    const key = canvas.keyWidth(pen, scene);
    const fits = (text, room) => canvas.widthOf(pen, text, NOTE) <= room;
    const whole = width - 2 * EDGE;
    if (fits(note, whole - key - 2 * EDGE)) return { lines: 1, notes: [note] };
    const [main, ...others] = note.split(", ");
    const more = [others.join(", "), ...others].find((text) => fits(text, whole));
    const short = [main, main.replace(/^motion /, "")].filter((text) => fits(text, whole)).slice(0, 1);
    const parts = height < ROOMY || !more ? short : [...short, more];
    const notes = fits(note, whole) ? [note] : parts;
    return { lines: 1 + notes.length, notes };
  }

  function drawNotes(pen, { lines, notes }, width, height) {
    const words = { base: "middle", size: NOTE, shade: color("muted") };
    notes.forEach((text, i) => {
      const y = height - LINE * (notes.length - i - 0.5) - 2;
      if (lines === 1) canvas.word(pen, text, width - EDGE, y, { ...words, align: "right" });
      else canvas.word(pen, text, EDGE, y, words);
    });
  }

  function drawBodies(pen, seen, bodies, touch) {
    const [ball, other] = bodies;
    if (other.kind === "sphere") drawBall(pen, seen, other, contact.outline(other, touch, 1), "second");
    else drawGround(pen, seen, other);
    drawBall(pen, seen, ball, contact.outline(ball, touch, 0), "first");
  }

  function draw(element, scene, share) {
    const sheet = element && canvas.ready(element);
    if (!sheet || !scene) return;
    const { pen, width, height } = sheet;
    const { stage } = scene.data;
    const foot = footOf(pen, scene, width, height);
    const low = height - LINE * foot.lines - 5;
    const seen = Carom.view.of(stage, width, low);
    const now = scene.at(share);
    const bodies = scene.bodiesAt(share);
    const touch = contact.between(...bodies);
    const strong = share <= 0.5 ? "before" : "after";
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, width, low);
    pen.clip();
    drawBodies(pen, seen, bodies, touch);
    if (touch && !now.apart) drawContact(pen, seen, touch, now);
    pen.restore();
    const boxes = canvas.layer(element, "motion", sheet, [scene, strong, Carom.hand.throws(), seen, Carom.level.isFull()], (own) => {
      drawNotes(own, foot, width, height);
      return drawMotion(own, seen, stage.bodies, strong);
    });
    if (!Carom.hand.throws()) drawGone(pen, seen, stage, bodies[0], share);
    if (touch && !now.apart) drawForce(pen, seen, touch, now, boxes);
    canvas.drawKey(pen, now, EDGE, low + 5 + LINE / 2 - 2);
    drawings.set(element, { seen, ball: bodies[0], scene });
    if (element.id === "stage") Carom.hand.draw(pen, drawings.get(element));
  }

  return { draw, last: (element) => drawings.get(element) };
})();
