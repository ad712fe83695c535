// The support sole from above with ZMP and divergent component: planned and measured, with where they just were.

const TRAIL = 0.6;
const ZMP = '#5ad1a0';
const DCM = '#c99bff';

export class SolePlot {
  constructor(canvas, robot) {
    this.canvas = canvas;
    this.robot = robot;
  }

  draw(timeline, time) {
    const { canvas, robot: { sole } } = this;
    const ratio = Math.min(devicePixelRatio, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width) return;
    if (canvas.width !== Math.round(width * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);

    const now = timeline.frames[timeline.indexAt(time)];
    // As the foot is seen by its robot: ahead is up, left is left.
    const length = sole.ahead + sole.behind;
    const scale = height / (1.45 * length);
    const [right, left] = now.support ? [sole.inside, sole.outside] : [sole.outside, sole.inside];
    const middle = (sole.ahead - sole.behind) / 2;
    const at = ([x, y]) => [width / 2 - scale * y, height / 2 - scale * (x - middle)];

    pen.strokeStyle = '#232c36';
    pen.fillStyle = '#66727f';
    pen.font = '10px system-ui, sans-serif';
    pen.lineWidth = 1;
    const step = 0.05 * Math.max(1, Math.round(length / 0.28));
    for (let y = -1; y <= 1; y += step) {
      const [x] = at([0, y]);
      if (x < 0 || x > width) continue;
      pen.beginPath();
      pen.moveTo(x, 0);
      pen.lineTo(x, height);
      pen.stroke();
    }
    for (let x = -1; x <= 1; x += step) {
      const [, y] = at([x, 0]);
      if (y < 0 || y > height) continue;
      pen.beginPath();
      pen.moveTo(0, y);
      pen.lineTo(width, y);
      pen.stroke();
    }
    pen.fillText(`grid ${Math.round(step * 1000)} mm`, 4, height - 5);

    const corners = [[sole.ahead, -right], [sole.ahead, left], [-sole.behind, left], [-sole.behind, -right]].map(at);
    pen.beginPath();
    corners.forEach((corner, index) => (index ? pen.lineTo(...corner) : pen.moveTo(...corner)));
    pen.closePath();
    pen.fillStyle = now.support ? 'rgb(240 160 96 / 16%)' : 'rgb(74 163 223 / 18%)';
    pen.strokeStyle = now.support ? '#f0a060' : '#4aa3df';
    pen.lineWidth = 1.5;
    pen.fill();
    pen.stroke();
    const [ankleX, ankleY] = at([0, 0]);
    pen.beginPath();
    pen.moveTo(ankleX - 4, ankleY);
    pen.lineTo(ankleX + 4, ankleY);
    pen.moveTo(ankleX, ankleY - 4);
    pen.lineTo(ankleX, ankleY + 4);
    pen.stroke();

    // Points are in the support sole's frame: what was before the support change is in another one.
    const frames = timeline.between(time - TRAIL, time).filter(({ half_step: index }) => index === now.half_step);
    const trail = (key, colour, dashes) => {
      pen.beginPath();
      let drawn = false;
      frames.forEach((frame) => {
        if (!frame[key]) return;
        const point = at(frame[key]);
        if (drawn) pen.lineTo(...point);
        else pen.moveTo(...point);
        drawn = true;
      });
      pen.strokeStyle = colour;
      pen.globalAlpha = 0.75;
      pen.lineWidth = 1.6;
      pen.setLineDash(dashes);
      pen.stroke();
      pen.setLineDash([]);
      pen.globalAlpha = 1;
    };
    trail('zmp_planned', ZMP, [4, 3]);
    trail('dcm_planned', DCM, [4, 3]);
    trail('zmp', ZMP, []);
    trail('dcm', DCM, []);
    const dot = (point, colour, size, filled) => {
      if (!point) return;
      pen.beginPath();
      pen.arc(...at(point), size, 0, 2 * Math.PI);
      pen.lineWidth = 1.6;
      pen.strokeStyle = colour;
      pen.fillStyle = colour;
      if (filled) pen.fill();
      else pen.stroke();
    };
    dot(now.zmp_planned, ZMP, 5, false);
    dot(now.dcm_planned, DCM, 5, false);
    dot(now.zmp, ZMP, 4, true);
    dot(now.dcm, DCM, 4, true);
  }
}
