// The panel.
$('title').textContent = data.title;
document.title = 'bodice: ' + data.title;
const counts = [];
if (skin) counts.push(`${skin.vertices.toLocaleString('en')} vertices`);
if (data.ellipsoids) counts.push(`${bytes(data.ellipsoids.part).byteLength} ellipsoids`);
$('facts').textContent = counts.join(', ') + (data.tier ? ` of tier ${data.tier}` : '') + '.' +
  (data.gap_mm ? ` Gap ${data.gap_mm[0].toFixed(2)} mm on average, 95 % within ${data.gap_mm[1].toFixed(2)} mm.` : '');
for (const sentence of data.lacks) { const p = document.createElement('p'); p.className = 'small'; p.textContent = sentence; $('lacks').append(p); }
$('least').textContent = `-${limit} mm`;
$('most').textContent = `+${limit} mm`;
const notes = [], kept = skin ? bytes(skin.positions).byteLength / 6 : 0;
if (skin && skin.vertices > kept) notes.push(`thinned to ${kept.toLocaleString('en')} vertices`);
if (data.left_out) notes.push(`${data.left_out} kept frames left out`);
if (skin && skin.frames && error) notes.push('colors are those of the pose at rest');
if (large) $('note').textContent = notes.join('; ');
function box(name, on, change) {
  const text = document.createElement('label'), input = document.createElement('input');
  input.type = 'checkbox';
  input.checked = on;
  input.onchange = () => { change(input.checked); draw(); };
  text.append(input, ' ' + name);
  $('show').append(text);
}
// The parts of skin and ellipsoids, below a line that opens.
function partBoxes() {
  const present = [...new Set(Object.values(meshes).flatMap(mesh => mesh.parts ? [...new Set(mesh.parts)] : []))].sort((a, b) => a - b);
  if (present.length < 2) return;
  const details = document.createElement('details'), summary = document.createElement('summary');
  details.id = 'parts';
  summary.textContent = 'parts';
  details.append(summary);
  const boxes = present.map(p => {
    const text = document.createElement('label'), input = document.createElement('input'), color = document.createElement('i');
    input.type = 'checkbox';
    input.checked = true;
    input.onchange = () => { hidden[input.checked ? 'delete' : 'add'](p); showParts(); draw(); };
    color.style.background = `rgb(${data.colors[p].map(c => Math.round(255 * c))})`;
    text.append(input, color, data.parts[p]);
    details.append(text);
    return input;
  });
  const flip = document.createElement('button');
  flip.className = 'link';
  flip.textContent = 'all or none';
  flip.onclick = () => {
    const on = hidden.size > 0;
    boxes.forEach((input, i) => { input.checked = on; hidden[on ? 'delete' : 'add'](present[i]); });
    showParts(); draw();
  };
  details.append(flip);
  $('show').append(details);
}
for (const [name, mesh] of Object.entries(meshes)) box(name, mesh.on, on => { mesh.on = on; if (mesh === meshes.skin) showLegend(document.querySelector('[name=by]:checked').value); });
if (data.landmarks.length) box('landmarks', false, on => { showLandmarks = on; });
partBoxes();
const showLegend = by => { $('legend').style.display = by === 'error' && meshes.skin.on ? '' : 'none'; };
$('by').hidden = !skin;
$('errors').hidden = !error;
if (!error) $('legend').style.display = 'none';
for (const radio of document.querySelectorAll('[name=by]')) {
  radio.checked = radio.value === skinBy;
  radio.parentElement.hidden = radio.value === 'error' && !error || radio.value === 'part' && !part;
  radio.onchange = () => { meshes.skin.colors = skinColors(radio.value); meshes.skin.dirty = true; showLegend(radio.value); draw(); };
}

// When each task ran: bars begin where it began, in a color for its thread. Pages of files have the lengths alone.
$('spent').hidden = !data.stages.length;
const total = data.stages.reduce((sum, s) => sum + s[1], 0) || 1, end = Math.max(1e-9, ...data.tasks.map(t => t[1] + t[2]));
const duration = ms => `${ms < 10 ? ms.toFixed(1) : ms.toFixed(0)} ms`;
function bar(into, name, [left, width], thread, ms, title) {
  const row = document.createElement('div'), rail = document.createElement('s'), length = document.createElement('i');
  length.style.marginLeft = Math.min(99, 100 * left) + '%';
  length.style.width = 100 * width + '%';
  length.hidden = width === 0;
  length.className = 'thread' + thread % 3;
  rail.append(length);
  row.append(name, rail, duration(ms));
  row.title = title;
  into.append(row);
}
const longest = Math.max(...data.stages.map(s => s[1]));
for (const [name, ms] of data.stages) {
  const task = data.tasks.filter(t => t[0] === name).sort((a, b) => Math.abs(a[2] - ms) - Math.abs(b[2] - ms))[0];
  bar($('stages'), name, task ? [task[1] / end, task[2] / end] : data.tasks.length ? [0, 0] : [0, ms / longest], task ? task[3] : 0, ms,
      `${(100 * ms / total).toFixed(0)} % of ${total.toFixed(0)} ms` + (task ? `, begins at ${duration(task[1])}` : ''));
}
if (data.tasks.length) {
  const details = document.createElement('details'), summary = document.createElement('summary'), rows = document.createElement('div');
  const threads = 1 + Math.max(...data.tasks.map(t => t[3]));
  summary.textContent = `all ${data.tasks.length} tasks on ${threads} ${threads > 1 ? 'threads' : 'thread'}, from left to right ${duration(end)}`;
  rows.className = 'bars';
  for (const [name, begin, ms, thread] of data.tasks)
    bar(rows, name, [begin / end, ms / end], thread, ms, `thread ${thread + 1}, begins at ${duration(begin)}`);
  details.id = 'tasks';
  details.append(summary, rows);
  $('spent').append(details);
}
$('warned').hidden = !data.warnings.length;
for (const warning of data.warnings) {
  const item = document.createElement('li');
  const name = nameIn(warning);
  if (name) {
    const link = document.createElement('button');
    link.textContent = warning.text;
    link.title = 'look at ' + name;
    link.onclick = () => lookAt(name);
    item.append(link);
  } else {
    item.textContent = warning.text;
  }
  $('warnings').append(item);
}
function partsOf(name) {
  return data.parts.map((p, i) => name && part && (p === name || p.startsWith(name) || name.includes(p)) ? i : -1).filter(i => i >= 0);
}
// The landmark or part that a warning is about, or that its text names.
function nameIn(warning) {
  const names = [...data.landmarks.map(l => l.name), ...data.parts];
  if (warning.part && (names.includes(warning.part) || partsOf(warning.part).length)) return warning.part;
  return part ? warning.text.split(/[^a-z_]+/).find(word => word.includes('_') && names.includes(word)) : undefined;
}
// A warning leads to the middle of its part, or of the first part that has it in its name.
function lookAt(name) {
  const which = partsOf(name);
  const mark = data.landmarks.find(l => l.name === name);
  center = home.slice(); zoom = 1;
  if (mark) { center = mark.at.slice(); zoom = 4; }
  else if (which.length) {
    const at = meshes.skin.frames[Math.min(frame, meshes.skin.frames.length - 1)](), sum = [0, 0, 0];
    let count = 0;
    part.forEach((p, v) => { if (which.includes(p)) { for (let k = 0; k < 3; ++k) sum[k] += at[3 * v + k]; ++count; } });
    if (count) { center = sum.map(s => s / count); zoom = 2.5; }
  }
  stage.focus();
  draw();
}

function download(name, type, make) {
  const link = document.createElement('a');
  link.textContent = name;
  link.href = '#';
  link.download = name;
  link.onclick = () => { const url = URL.createObjectURL(new Blob([make()], {type})); link.href = url; setTimeout(() => { URL.revokeObjectURL(url); link.href = '#'; }, 5000); };
  $('files').append(link);
}
if (data.report) download('report.json', 'application/json', () => data.report);
if (error) download('errors.csv', 'text/csv', () => {
  const at = positions(skin.positions);
  return 'x_m,y_m,z_m,part,error_mm\n' + Array.from(error, (e, v) => `${at[3 * v].toFixed(5)},${at[3 * v + 1].toFixed(5)},${at[3 * v + 2].toFixed(5)},${part ? data.parts[part[v]] : ''},${e / 100}`).join('\n') + '\n';
});
if (data.drape && data.drape.penetration.length) download('frames.csv', 'text/csv', () => 'frame,penetration_mm\n' + data.drape.penetration.map((d, f) => `${f + 1},${d}`).join('\n') + '\n');

// Charts.
function chart(id) {
  const c = $(id), scale = Math.min(2, window.devicePixelRatio || 1), context = c.getContext('2d');
  c.width = c.clientWidth * scale; c.height = c.clientHeight * scale;
  context.scale(scale, scale);
  const ink = getComputedStyle(document.body).color;
  context.fillStyle = context.strokeStyle = ink;
  context.font = '11px system-ui, sans-serif';
  return {context, w: c.clientWidth, h: c.clientHeight, ink};
}
function histogram() {
  if (!error) return;
  const {context, w, h, ink} = chart('histogram'), bins = new Array(41).fill(0), top = 1.5 * limit;
  for (const e of error) ++bins[Math.round(Math.max(-1, Math.min(1, e / 100 / top)) * 20) + 20];
  const most = Math.max(...bins), width = w / bins.length;
  bins.forEach((count, i) => {
    const color = ramp((i - 20) / 20 * top).map(v => Math.round(255 * v));
    context.fillStyle = `rgb(${color})`;
    const height = count / most * (h - 16);
    context.fillRect(i * width, h - 14 - height, width - 1, height);
  });
  context.fillStyle = ink;
  context.fillText(`-${top.toFixed(1)}`, 0, h - 2);
  context.fillText('0', w / 2 - 3, h - 2);
  context.textAlign = 'right';
  context.fillText(`+${top.toFixed(1)}`, w, h - 2);
}
function curve() {
  if (!data.drape || $('time').hidden) return;
  const {context, w, h, ink} = chart('curve'), d = data.drape.penetration, kept = data.drape.kept;
  if (!d.length && kept.length < 2) return;
  const most = Math.max(1e-3, ...d, ...kept.map(k => k[1])), y = v => h - 4 - v / most * (h - 10), left = 4, right = w - 4;
  // Frames count from 1; the kept ones begin before the first.
  const across = share => left + (right - left) * share, last = kept.length ? kept[kept.length - 1][0] - kept[0][0] || 1 : 1;
  const line = (points, color) => {
    context.strokeStyle = color; context.lineWidth = 1.5; context.beginPath();
    for (const [share, v] of points) context.lineTo(across(share), y(Math.max(0, v)));
    context.stroke();
  };
  line(d.map((v, i) => [(i + 1) / d.length, v]), '#b3261e');
  if (kept.length > 1) line(kept.map(k => [(k[0] - kept[0][0]) / last, k[1]]), '#2166cc');
  const worst = data.drape.worst;
  context.fillStyle = '#b3261e';
  if (worst) { context.beginPath(); context.arc(across(worst / d.length), y(d[worst - 1]), 4, 0, 7); context.fill(); }
  context.strokeStyle = ink; context.lineWidth = 1;
  const now = across(shareOfTime());
  context.beginPath(); context.moveTo(now, 2); context.lineTo(now, h); context.stroke();
}
// What the curves are, and a button that leads to the worst frame.
function caption() {
  if (!data.drape) return;
  const d = data.drape.penetration, kept = data.drape.kept, worst = data.drape.worst;
  const add = (tag, text, kind) => { const e = document.createElement(tag); e.textContent = text; if (kind) e.className = kind; $('caption').append(e, ' '); return e; };
  if (d.length && !worst) add('span', 'No particle is inside the skin in any frame.');
  if (worst && d.length) {
    add('span', `Deepest particle in the skin: ${Math.max(...d).toFixed(2)} mm,`);
    const jump = add('button', `frame ${worst}`);
    jump.title = 'show the worst frame';
    jump.onclick = () => { play(false); show(frameNear(worst / d.length)); };
    $('caption').append('at worst. ');
  }
  if (kept.length > 1) add('span', `Error of the posed proxy: up to ${Math.max(...kept.map(k => k[1])).toFixed(2)} mm.`, 'blue');
}
// The frame of the page that is nearest to a share of the time.
function frameNear(share) {
  const at = times.map(t => Math.abs((t - times[0]) / (times[times.length - 1] - times[0]) - share));
  return at.indexOf(Math.min(...at));
}
const shareOfTime = () => times.length > 1 && times[times.length - 1] > times[0] ? (times[frame] - times[0]) / (times[times.length - 1] - times[0]) : 0;

// Time.
function show(next) {
  frame = (next + times.length) % times.length;
  for (const mesh of Object.values(meshes)) if (mesh.frames.length > 1) mesh.dirty = true;
  $('scrub').value = frame;
  $('now').textContent = `${times[frame].toFixed(2)} s`;
  curve();
  draw();
}
function play(on) {
  playing = on;
  $('play').textContent = on ? '\u275a\u275a' : '\u25b6';
  if (!on) return;
  let last = performance.now();
  const step = (times[times.length - 1] - times[0]) / (times.length - 1) * 1000 || 40;
  const tick = now => { if (!playing) return; if (now - last >= step) { last = now; show(frame + 1); } requestAnimationFrame(tick); };
  requestAnimationFrame(tick);
}
if (times.length > 1) {
  $('time').hidden = false;
  $('scrub').max = times.length - 1;
  $('scrub').oninput = () => { play(false); show(Number($('scrub').value)); };
  $('play').onclick = () => play(!playing);
  caption();
  show(times.length - 1);
}

// Hands and keys.
const pointers = new Map();
stage.onpointerdown = e => { pointers.set(e.pointerId, e); stage.setPointerCapture(e.pointerId); };
stage.onpointerup = stage.onpointercancel = e => pointers.delete(e.pointerId);
stage.onpointermove = e => {
  const before = pointers.get(e.pointerId);
  if (!before) return;
  if (pointers.size === 1) {
    yaw -= (e.clientX - before.clientX) * .008;
    pitch = Math.max(-1.5, Math.min(1.5, pitch + (e.clientY - before.clientY) * .008));
  } else {
    const other = [...pointers.values()].find(p => p.pointerId !== e.pointerId);
    const span = p => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY) || 1;
    zoom = Math.max(.3, Math.min(30, zoom * span(e) / span(before)));
  }
  pointers.set(e.pointerId, e);
  draw();
};
stage.addEventListener('wheel', e => { e.preventDefault(); zoom = Math.max(.3, Math.min(30, zoom * Math.exp(-e.deltaY * .0012))); draw(); }, {passive: false});
const keys = {
  ArrowLeft: () => { yaw -= .12; }, ArrowRight: () => { yaw += .12; },
  ArrowUp: () => { pitch = Math.min(1.5, pitch + .1); }, ArrowDown: () => { pitch = Math.max(-1.5, pitch - .1); },
  '+': () => { zoom *= 1.15; }, '=': () => { zoom *= 1.15; }, '-': () => { zoom /= 1.15; },
  r: () => { ({yaw, pitch, zoom} = start); center = home.slice(); },
  ' ': () => { if (times.length > 1) play(!playing); },
  ',': () => { if (times.length > 1) show(frame - 1); }, '.': () => { if (times.length > 1) show(frame + 1); },
};
addEventListener('keydown', e => {
  if (e.target.matches('input, button, a') && e.key !== ',' && e.key !== '.') return;
  const act = keys[e.key] || keys[e.key.toLowerCase()];
  if (!act || e.ctrlKey || e.metaKey || e.altKey) return;
  e.preventDefault();
  act();
  draw();
});
const all = () => { histogram(); curve(); draw(); };
addEventListener('resize', all);
all();
if (large) document.body.dataset.ready = 'yes';
document.body.dataset.ms = Math.round(performance.now());
