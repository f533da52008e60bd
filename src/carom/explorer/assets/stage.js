// The balls as they meet and part: motion magnified, contact flattened, path and speeds.
window.Carom = window.Carom || {};

Carom.stage = (() => {
  const { canvas, contact } = Carom;
  const NEAR = 0.4; // tips of arrows, too near for two names
  const SHORT = 0.08; // arrows that are not drawn
  const FORCE = 1.1; // the largest tangential force, likewise
  const FOOT = 24; // pixels for the words below
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

  // A plane or a block with a hollow: all that is below its surface.
  function drawGround(pen, seen, body, width, height) {
    const left = -seen.x / seen.unit;
    const right = (width - seen.x) / seen.unit;
    const low = (seen.y - (height - FOOT)) / seen.unit;
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
    pen.lineTo(right, low);
    pen.lineTo(left, low);
    pen.closePath();
    pen.fillStyle = color("ground");
    pen.fill();
    pen.restore();
  }

  function drawPath(pen, seen, stage, share) {
    const [ball] = stage.bodies;
    const now = Carom.scene.bodiesAt(share)[0];
    pen.beginPath();
    ball.x.forEach((x, i) => pen[i ? "lineTo" : "moveTo"](...seen.at([x, ball.y[i]])));
    pen.setLineDash([3, 4]);
    pen.lineWidth = 1.5;
    pen.strokeStyle = color("accent");
    pen.stroke();
    pen.setLineDash([]);
    pen.beginPath();
    ball.x.forEach((x, i) => {
      if (stage.time[i] <= share) pen[i ? "lineTo" : "moveTo"](...seen.at([x, ball.y[i]]));
    });
    pen.lineTo(...seen.at([now.x, now.y]));
    pen.lineWidth = 2.5;
    pen.stroke();
    pen.beginPath();
    pen.arc(...seen.at([now.x, now.y]), 4, 0, 2 * Math.PI);
    pen.fillStyle = color("accent");
    pen.fill();
  }

  // Velocities, the one of the nearer end strong, the other faint.
  function drawSpeeds(pen, seen, stage, share) {
    const all = Carom.view.arrows(stage);
    const apart = all.length && Math.hypot(all[0].tip[0] - all[1].tip[0], all[0].tip[1] - all[1].tip[1]);
    for (const { when, from, to, tip, length, first } of all) {
      if (length < SHORT) continue;
      const strong = (when === "before") === share <= 0.5;
      pen.globalAlpha = strong ? 1 : 0.45;
      canvas.arrow(pen, ...seen.at(from), ...seen.at(to), color(when), 3);
      const [x, y] = seen.at(tip);
      if (first && (strong || apart > NEAR)) canvas.haloed(pen, when, x, y - 7, { align: "center" });
      pen.globalAlpha = 1;
    }
  }

  function drawContact(pen, seen, touch, now) {
    const share = now.contact > 0 ? now.stick / now.contact : 0;
    const stretch = (from, to, shade, width) => {
      if (to <= from) return;
      pen.beginPath();
      for (let i = 0; i <= 12; i++) {
        pen[i ? "lineTo" : "moveTo"](...seen.at(touch.at(from + ((to - from) * i) / 12)));
      }
      pen.strokeStyle = shade;
      pen.lineWidth = width;
      pen.lineCap = "butt";
      pen.stroke();
    };
    stretch(-1, -share, canvas.phaseColor(now.kind, now.sign), 5);
    stretch(share, 1, canvas.phaseColor(now.kind, now.sign), 5);
    stretch(-share, share, color("stick"), 8);
  }

  // Friction on the first body, against the traction on the second.
  function drawForce(pen, seen, touch, now) {
    const length = -now.force * FORCE;
    if (Math.abs(length) < SHORT) return;
    const [x, y] = touch.at(0);
    const [dx, dy] = touch.along;
    const lift = 0.2;
    const from = [x - dy * lift, y + dx * lift];
    const to = [from[0] + dx * length, from[1] + dy * length];
    canvas.arrow(pen, ...seen.at(from), ...seen.at(to), color("force"), 3);
    const side = length < 0 ? "right" : "left";
    const [px, py] = seen.at(to);
    canvas.haloed(pen, "friction", px + (length < 0 ? -4 : 4), py - 4, { align: side });
  }

  function drawLegend(pen, width, height, caption, now) {
    const y = height - 8;
    canvas.word(pen, caption, width - 8, y, { align: "right", size: 11.5, color: color("muted") });
    if (now.apart) return;
    const parts = [["stick", color("stick"), 8, now.stick > 0]];
    const slips = now.sign !== 0 && now.stick < now.contact;
    parts.push([now.phase, canvas.phaseColor(now.kind, now.sign), 5, slips]);
    let x = 8;
    for (const [text, shade, thick, shown] of parts) {
      if (!shown) continue;
      pen.fillStyle = shade;
      pen.fillRect(x, y - 4 - thick / 2, 18, thick);
      canvas.word(pen, text, x + 23, y, { size: 11.5 });
      x += 36 + pen.measureText(text).width;
    }
  }

  function draw(share) {
    const element = document.getElementById("stage");
    const sheet = element && canvas.ready(element);
    const data = Carom.scene.data();
    if (!sheet || !data) return;
    const { pen, width, height } = sheet;
    const { stage } = data;
    const seen = Carom.view.of(stage, width, height, FOOT);
    const now = Carom.scene.at(share);
    const [ball, other] = Carom.scene.bodiesAt(share);
    const touch = contact.between(ball, other);
    pen.save();
    pen.beginPath();
    pen.rect(0, 0, width, height - FOOT);
    pen.clip();
    if (other.kind === "sphere") drawBall(pen, seen, other, contact.outline(other, touch, 1), "second");
    else drawGround(pen, seen, other, width, height);
    drawBall(pen, seen, ball, contact.outline(ball, touch, 0), "first");
    if (touch && !now.apart) drawContact(pen, seen, touch, now);
    drawPath(pen, seen, stage, share);
    drawSpeeds(pen, seen, stage, share);
    if (touch && !now.apart) drawForce(pen, seen, touch, now);
    pen.restore();
    drawLegend(pen, width, height, stage.caption || "", now);
  }

  return { draw };
})();
