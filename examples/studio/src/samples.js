// Pictures that the page draws itself, and the cages that go with them.

const SIZE = 640;

function canvas() {
  const c = document.createElement('canvas');
  c.width = c.height = SIZE;
  return [c, c.getContext('2d')];
}

/** A backdrop: a soft vertical shade and a lattice of fine lines, on which one sees what bends. */
function backdrop(g, top, bottom, line) {
  const shade = g.createLinearGradient(0, 0, 0, SIZE);
  shade.addColorStop(0, top);
  shade.addColorStop(1, bottom);
  g.fillStyle = shade;
  g.fillRect(0, 0, SIZE, SIZE);
  g.strokeStyle = line;
  g.lineWidth = 1;
  g.beginPath();
  for (let k = 0; k <= SIZE; k += 32) {
    g.moveTo(k + 0.5, 0); g.lineTo(k + 0.5, SIZE);
    g.moveTo(0, k + 0.5); g.lineTo(SIZE, k + 0.5);
  }
  g.stroke();
}

const blob = (g, fill, x, y, rx, ry, turn = 0) => {
  g.fillStyle = fill;
  g.beginPath();
  g.ellipse(x, y, rx, ry, turn, 0, 2 * Math.PI);
  g.fill();
};

const curve = (g, fill, path) => { g.fillStyle = fill; g.fill(new Path2D(path)); };

function wing(g) {
  curve(g, '#c8502d', 'M320 300C350 160 470 90 560 110C600 190 560 310 330 330Z');
  curve(g, '#e2733c', 'M324 300C360 190 460 120 540 128C570 200 530 290 336 318Z');
  curve(g, '#f3ad55', 'M330 296C370 220 440 160 512 158C528 210 490 268 344 306Z');
  curve(g, '#8f2f3a', 'M326 330C440 330 530 380 520 470C480 540 380 520 324 380Z');
  curve(g, '#b8443f', 'M332 344C430 346 500 390 494 456C462 510 384 490 334 384Z');
  for (const [x, y, r] of [[548, 134, 10], [566, 170, 9], [566, 210, 8], [552, 248, 8], [524, 282, 7]]) blob(g, '#fbf3df', x, y, r, r);
  blob(g, '#fbf3df', 462, 214, 26, 26);
  blob(g, '#263a52', 462, 214, 17, 17);
  blob(g, '#fbf3df', 468, 208, 5, 5);
  blob(g, '#f6d9a3', 436, 434, 22, 20);
  blob(g, '#263a52', 436, 434, 12, 11);
}

function butterfly() {
  const [c, g] = canvas();
  backdrop(g, '#eef0e6', '#d8e2da', 'rgba(60,90,80,.13)');
  for (const side of [1, -1]) {
    g.save();
    g.translate(320, 0);
    g.scale(side, 1);
    g.translate(-320, 0);
    wing(g);
    g.strokeStyle = '#2b2730';
    g.lineWidth = 4;
    g.stroke(new Path2D('M324 220C336 170 360 140 384 124'));
    blob(g, '#2b2730', 386, 122, 6, 6);
    g.restore();
  }
  blob(g, '#2b2730', 320, 340, 15, 120);
  blob(g, '#463f4c', 320, 250, 17, 30);
  blob(g, '#2b2730', 320, 214, 15, 15);
  return c;
}

function owl() {
  const [c, g] = canvas();
  backdrop(g, '#26314a', '#44506b', 'rgba(255,255,255,.07)');
  blob(g, '#f4e9c8', 500, 120, 56, 56);
  curve(g, '#6f5138', 'M190 150C230 190 410 190 450 150C470 260 500 330 470 430C440 540 380 580 320 580C260 580 200 540 170 430C140 330 170 260 190 150Z');
  for (let row = 0; row < 7; ++row)
    for (let k = -3; k <= 3; ++k) blob(g, row % 2 ? '#c99d63' : '#b58551', 320 + k * 32 + (row % 2) * 16, 340 + row * 30, 13, 17);
  for (const x of [250, 390]) {
    blob(g, '#e8d1a2', x, 262, 66, 66);
    blob(g, '#f5a623', x, 262, 44, 44);
    blob(g, '#1d1a20', x, 262, 24, 24);
    blob(g, '#ffffff', x + 9, 253, 7, 7);
  }
  curve(g, '#f0b64a', 'M300 306L340 306L320 352Z');
  return c;
}

function squares() {
  const [c, g] = canvas();
  for (let j = 0; j < 16; ++j)
    for (let i = 0; i < 16; ++i) {
      g.fillStyle = (i + j) % 2 ? `hsl(${200 + 8 * i} 42% ${88 - 2 * j}%)` : `hsl(${200 + 8 * i} 40% ${44 - j}%)`;
      g.fillRect(40 * i, 40 * j, 40, 40);
    }
  blob(g, '#d9482b', 60, 60, 14, 14);
  blob(g, '#e5a823', 580, 60, 14, 14);
  blob(g, '#2f8f6b', 580, 580, 14, 14);
  blob(g, '#7b4fb0', 60, 580, 14, 14);
  return c;
}

function harbour() {
  const [c, g] = canvas();
  backdrop(g, '#f6d7b0', '#8fb7c9', 'rgba(255,255,255,.0)');
  blob(g, '#f4764f', 430, 250, 62, 62);
  g.fillStyle = '#3f6c86';
  g.fillRect(0, 330, SIZE, 310);
  for (let k = 0; k < 12; ++k) {
    g.fillStyle = k % 2 ? '#4f7f99' : '#5f90a8';
    g.fillRect(0, 340 + k * k * 2.2, SIZE, 3 + k * 0.5);
  }
  for (const [x, y, s] of [[220, 410, 1.5], [470, 380, 0.8]]) {
    g.save();
    g.translate(x, y);
    g.scale(s, s);
    curve(g, '#7c2f2a', 'M-80 0L80 0L54 40L-54 40Z');
    curve(g, '#faf3e6', 'M-4 -8L-4 -170L-74 -8Z');
    curve(g, '#eadcc0', 'M6 -8L6 -140L64 -8Z');
    g.fillStyle = '#4a3428';
    g.fillRect(-3, -176, 6, 180);
    g.restore();
  }
  return c;
}

function letter() {
  const [c, g] = canvas();
  backdrop(g, '#faf7f0', '#efe9dc', 'rgba(40,60,110,.14)');
  g.fillStyle = '#1f3a6e';
  g.font = '600 520px Georgia, "DejaVu Serif", serif';
  g.textAlign = 'center';
  g.textBaseline = 'alphabetic';
  g.fillText('R', 320, 510);
  return c;
}

const around = ([left, top, right, bottom], per) => {
  const corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
  return corners.flatMap((a, k) => Array.from({ length: per }, (_, i) =>
    a.map((v, axis) => v + ((corners[(k + 1) % 4][axis] - v) * i) / per)));
};

const mirrored = (half) => [...half, ...half.filter(([x]) => x !== 320).reverse().map(([x, y]) => [640 - x, y])];

const FIGURE = mirrored([[320, 66], [364, 82], [384, 128], [366, 172], [340, 192], [352, 208], [520, 206], [532, 228], [520, 252],
  [358, 262], [354, 384], [444, 560], [428, 586], [398, 582], [320, 432]]);

function figure() {
  const [c, g] = canvas(), path = new Path2D(`M${FIGURE.map((p) => p.join()).join('L')}Z`);
  backdrop(g, '#e4edf2', '#c9dbe3', 'rgba(40,80,100,.13)');
  g.save();
  g.clip(path);
  curve(g, '#a8652f', 'M0 0H640V640H0Z');
  g.strokeStyle = 'rgba(80,38,12,.35)';
  g.lineWidth = 3;
  g.beginPath();
  for (let k = 0; k < SIZE; k += 24) { g.moveTo(0, k); g.lineTo(SIZE, k); g.moveTo(k + 8, 0); g.lineTo(k + 8, SIZE); }
  g.stroke();
  g.strokeStyle = '#fbf3e4';
  g.lineWidth = 12;
  g.lineJoin = 'round';
  g.stroke(path);
  g.restore();
  for (const x of [298, 342]) blob(g, '#2a1a10', x, 112, 6, 8);
  g.strokeStyle = '#fbf3e4';
  g.lineWidth = 5;
  g.lineCap = 'round';
  g.stroke(new Path2D('M296 138Q320 162 344 138'));
  for (const [y, fill] of [[250, '#c8372d'], [296, '#2f8f5b'], [342, '#c8372d']]) blob(g, fill, 320, y, 10, 10);
  for (const x of [176, 464]) { g.strokeStyle = '#fbf3e4'; g.stroke(new Path2D(`M${x} 212l8 12l-8 12l8 12`)); }
  return c;
}

/** name -> [what it is called, the picture, its cage] */
export const SAMPLES = {
  butterfly: ['Butterfly', butterfly, mirrored([[320, 178], [372, 100], [470, 86], [590, 80], [612, 190],
    [572, 296], [470, 336], [548, 400], [540, 500], [440, 540], [360, 490], [320, 486]])],
  owl: ['Owl', owl, mirrored([[320, 160], [468, 126], [490, 250], [512, 360], [480, 480], [410, 580], [320, 604]])],
  squares: ['Squares', squares, around([40, 40, 600, 600], 4)],
  harbour: ['Harbour', harbour, around([64, 64, 576, 576], 3)],
  figure: ['Gingerbread figure', figure, FIGURE],
  letter: ['Letter', letter, around([110, 90, 560, 545], 5)],
};
