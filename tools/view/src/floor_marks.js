// What lies on the floor: footprints past and planned, the way walked, ZMP and divergent component, and the goal.
import * as THREE from 'three';

const COLOURS = [0x4aa3df, 0xf0a060];
const PRINTS = 240;

/** The outline of a sole with round corners, in its frame; `by` is how much smaller it is all round. */
function outline({ behind, ahead, inside, outside }, side, by) {
  const [right, left] = side ? [inside, outside] : [outside, inside];
  const [x0, x1, y0, y1] = [by - behind, ahead - by, by - right, left - by];
  const round = Math.min(0.3 * (y1 - y0), 0.12 * (x1 - x0));
  const shape = new THREE.Shape();
  shape.moveTo(x0 + round, y0);
  shape.lineTo(x1 - round, y0).quadraticCurveTo(x1, y0, x1, y0 + round);
  shape.lineTo(x1, y1 - round).quadraticCurveTo(x1, y1, x1 - round, y1);
  shape.lineTo(x0 + round, y1).quadraticCurveTo(x0, y1, x0, y1 - round);
  shape.lineTo(x0, y0 + round).quadraticCurveTo(x0, y0, x0 + round, y0);
  return shape;
}

function frame(sole, side, width) {
  const shape = outline(sole, side, 0);
  shape.holes.push(new THREE.Path(outline(sole, side, width).getPoints(6).reverse()));
  return new THREE.ShapeGeometry(shape, 6);
}

const UP = new THREE.Vector3(0, 0, 1);
const place = new THREE.Object3D();
const tilt = new THREE.Quaternion();
/** The place of a print so high over the floor, and as steep as this. */
function matrixOf([x, y, heading], over, floor) {
  const { height, normal } = floor.at(x, y);
  place.position.set(x, y, height + over);
  place.rotation.set(0, 0, heading);
  if (normal) place.quaternion.premultiply(tilt.setFromUnitVectors(UP, normal));
  place.updateMatrix();
  return place.matrix;
}

export class FloorMarks {
  constructor(robot, ghost = false) {
    const { sole, scale } = robot;
    this.group = new THREE.Group();
    const flat = (color, opacity) => new THREE.MeshBasicMaterial({
      color, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide, toneMapped: false,
    });
    const many = (geometry, material, order) => {
      const mesh = new THREE.InstancedMesh(geometry, material, PRINTS);
      mesh.frustumCulled = false;
      mesh.count = 0;
      mesh.renderOrder = order;
      this.group.add(mesh);
      return mesh;
    };
    const width = 0.007 * Math.sqrt(scale);
    const colour = (side) => (ghost ? 0xd46ad0 : COLOURS[side]);
    this.past = [0, 1].map((side) => [
      many(new THREE.ShapeGeometry(outline(sole, side, 0), 6), flat(colour(side), ghost ? 0.06 : 0.3), 2),
      many(frame(sole, side, width), flat(colour(side), ghost ? 0.5 : 0.75), 3),
    ]);
    const plannedColour = (side) => (ghost ? colour(side) : 0xffffff);
    this.planned = [0, 1].map((side) => many(frame(sole, side, 0.8 * width), flat(plannedColour(side), 0.85), 4));

    const way = new THREE.BufferGeometry();
    way.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * 4000), 3));
    const wayColour = ghost ? 0xd46ad0 : 0x8b98a8;
    this.way = new THREE.Line(way, new THREE.LineBasicMaterial({ color: wayColour, transparent: true, opacity: 0.7 }));
    this.way.frustumCulled = false;
    this.group.add(this.way);

    const disc = (color, radius, corners) => {
      const mesh = new THREE.Mesh(new THREE.CircleGeometry(radius * Math.sqrt(scale), corners), flat(color, 1));
      mesh.renderOrder = 6;
      mesh.material.depthTest = false;
      this.group.add(mesh);
      return mesh;
    };
    this.zmp = disc(0x5ad1a0, 0.014, 24);
    this.dcm = disc(0xc99bff, 0.016, 4);
    this.zmp.visible = this.dcm.visible = !ghost;
    this.ghost = ghost;
  }

  /** Shows what a timeline holds at a time, on a floor. */
  show(timeline, time, floor) {
    const frameNow = timeline.frames[timeline.indexAt(time)];
    const counts = [0, 0];
    timeline.footprints(time, PRINTS).forEach((print) => {
      const side = print[3];
      this.past[side].forEach((mesh) => mesh.setMatrixAt(counts[side], matrixOf(print, 0.002, floor)));
      counts[side] += 1;
    });
    this.past.forEach((meshes, side) => meshes.forEach((mesh) => {
      mesh.count = counts[side];
      mesh.instanceMatrix.needsUpdate = true;
    }));
    const steps = /walking|starting|stopping|in place/.test(frameNow.mode);
    this.planned.forEach((mesh) => { mesh.count = 0; });
    if (steps) {
      frameNow.landings.forEach((landing, index) => {
        const mesh = this.planned[(frameNow.support + 1 + index) % 2];
        mesh.setMatrixAt(0, matrixOf(landing, 0.004, floor));
        mesh.count = 1;
        mesh.instanceMatrix.needsUpdate = true;
      });
    }

    const frames = timeline.between(time - 120, time);
    const every = Math.max(1, Math.ceil(frames.length / 2000));
    const places = this.way.geometry.attributes.position;
    let count = 0;
    for (let index = 0; index < frames.length; index += every) {
      const [x, y] = frames[index].pose;
      places.setXYZ(count, x, y, floor.at(x, y).height + 0.003);
      count += 1;
    }
    places.needsUpdate = true;
    this.way.geometry.setDrawRange(0, count);

    if (!this.ghost) {
      const [x, y, heading] = frameNow.support_sole;
      const [c, s] = [Math.cos(heading), Math.sin(heading)];
      [[this.zmp, frameNow.zmp], [this.dcm, frameNow.dcm]].forEach(([mesh, point]) => {
        mesh.visible = point !== null;
        if (!point) return;
        const [px, py] = [x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]];
        mesh.position.set(px, py, floor.at(px, py).height + 0.006);
      });
    }
  }
}

/** Where the robot is to walk to: a ring with an arrow of the heading. */
export class GoalMark {
  constructor(scale) {
    this.group = new THREE.Group();
    const material = new THREE.MeshBasicMaterial({
      color: 0x5ad1a0, transparent: true, opacity: 0.9, side: THREE.DoubleSide, depthWrite: false, toneMapped: false,
    });
    const ring = new THREE.Mesh(new THREE.RingGeometry(0.13 * scale, 0.155 * scale, 40), material);
    const corners = [[0.33, 0], [0.17, 0.085], [0.17, -0.085]];
    const tip = new THREE.Shape(corners.map(([x, y]) => new THREE.Vector2(x * scale, y * scale)));
    this.arrow = new THREE.Mesh(new THREE.ShapeGeometry(tip), material);
    const pole = new THREE.Mesh(new THREE.CircleGeometry(0.03 * scale, 24), material);
    this.group.add(ring, this.arrow, pole);
    this.group.renderOrder = 5;
    this.group.visible = false;
  }

  show([x, y, z = 0], heading) {
    this.group.visible = true;
    this.group.position.set(x, y, z + 0.005);
    this.arrow.visible = heading !== null;
    this.group.rotation.set(0, 0, heading ?? 0);
  }

  hide() {
    this.group.visible = false;
  }
}
