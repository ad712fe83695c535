// The robot, drawn from its mechanism: a shell from joint to joint, drives at the joints, feet over the soles.
import * as THREE from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';

const RIGHT = 0x2f7fb8;
const LEFT = 0xe08a45;
const SHELL = 0xe9edf1;
const DARK = 0x39424d;
/** Joints nearer to each other than this meet in one point (m). */
const NEAR = 0.02;
/** Length of forearm and hand per distance of their centre of mass from the elbow; height of the head likewise. */
const HAND_BY_COM = 1 / 0.677;
const HEAD_BY_COM = 2.2;

/** A solid of revolution from one point to another, with a radius at each end, a bulge between, and round ends. */
function limb(from, to, [first, last], bulge = 1.08) {
  const way = new THREE.Vector3().subVectors(to, from);
  const length = way.length();
  const profile = [];
  const round = 7;
  for (let step = 0; step <= round; step += 1) {
    const angle = (Math.PI / 2) * (step / round);
    profile.push(new THREE.Vector2(first * Math.sin(angle), -first * Math.cos(angle)));
  }
  for (let step = 1; step < 12; step += 1) {
    const share = step / 12;
    const radius = first + (last - first) * share;
    profile.push(new THREE.Vector2(radius * (1 + (bulge - 1) * Math.sin(Math.PI * Math.sqrt(share))), length * share));
  }
  for (let step = 0; step <= round; step += 1) {
    const angle = (Math.PI / 2) * (step / round);
    profile.push(new THREE.Vector2(last * Math.cos(angle), length + last * Math.sin(angle)));
  }
  const geometry = new THREE.LatheGeometry(profile, 28);
  geometry.applyQuaternion(new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), way.normalize()));
  geometry.translate(from.x, from.y, from.z);
  return geometry;
}

/** A drive: a cylinder about an axis. */
function drive(axis, radius, length) {
  const geometry = new THREE.CylinderGeometry(radius, radius, length, 30);
  geometry.applyQuaternion(new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis));
  return geometry;
}

/** A foot over the sole, in the sole's frame: its outline from the side, as wide as the sole. */
function footOver({ behind, ahead, ankle_height: height }, right, left) {
  const outline = new THREE.Shape();
  const top = Math.min(height, 0.45 * (ahead + behind));
  outline.moveTo(-behind, 0);
  outline.lineTo(ahead, 0);
  outline.quadraticCurveTo(ahead, 0.32 * top, 0.72 * ahead, 0.4 * top);
  outline.lineTo(0.32 * ahead, 0.8 * top);
  outline.lineTo(-0.45 * behind, 0.86 * top);
  outline.quadraticCurveTo(-behind, 0.7 * top, -behind, 0.25 * top);
  outline.closePath();
  const bevel = Math.min(0.006, 0.08 * (right + left));
  const geometry = new THREE.ExtrudeGeometry(outline, {
    depth: right + left - 2 * bevel, bevelEnabled: true, bevelSize: bevel, bevelThickness: bevel, bevelSegments: 3,
    bevelOffset: -bevel,
  });
  // The extrusion goes along y, to the left, from the right edge.
  geometry.rotateX(Math.PI / 2);
  geometry.translate(0, left - bevel, 0);
  return geometry;
}

export class Robot {
  /** `ghost` draws it translucent in one colour. */
  constructor(drawing, ghost = false) {
    this.drawing = drawing;
    this.scale = drawing.scale;
    this.group = new THREE.Group();
    this.joints = drawing.joints.map((joint) => {
      const node = new THREE.Group();
      node.name = joint.name;
      return { ...joint, node, axis: new THREE.Vector3(...joint.axis), place: new THREE.Vector3(...joint.origin) };
    });
    const material = (color, roughness, metalness) => ghost
      ? new THREE.MeshStandardMaterial({
        color: 0xd46ad0, transparent: true, opacity: 0.33, roughness: 0.6, depthWrite: false,
      })
      : new THREE.MeshStandardMaterial({ color, roughness, metalness });
    this.materials = {
      shell: material(SHELL, 0.42, 0.05), dark: material(DARK, 0.5, 0.35), right: material(RIGHT, 0.4, 0.15),
      left: material(LEFT, 0.4, 0.15),
    };
    const root = drawing.feet[0];
    this.joints.forEach(({ node, place, parent }, index) => {
      if (index === root) this.group.add(node);
      else if (index > 1) {
        node.position.copy(place);
        this.joints[parent].node.add(node);
      }
    });
    this.ghost = ghost;
    this.#addBodies();
  }

  #part(index, geometry, material) {
    const mesh = new THREE.Mesh(geometry, this.materials[material]);
    mesh.castShadow = !this.ghost;
    mesh.receiveShadow = !this.ghost;
    mesh.userData.joint = index;
    this.joints[index].node.add(mesh);
    return mesh;
  }

  /** Right or left for what belongs to a side. */
  #side(index) {
    const { name } = this.joints[index];
    return name.startsWith('right') ? 'right' : name.startsWith('left') ? 'left' : 'dark';
  }

  #addBodies() {
    const { sole, feet, sole_in_foot: soleInFoot, trunk, pelvis, scale } = this.drawing;
    const at = (name) => this.joints.findIndex((joint) => joint.name === name);
    const origin = new THREE.Vector3();
    const zero = (vector) => vector.length() < NEAR * scale;

    feet.forEach((foot, side) => {
      const [right, left] = side ? [sole.inside, sole.outside] : [sole.outside, sole.inside];
      const geometry = footOver(sole, right, left);
      geometry.translate(...soleInFoot[side]);
      this.#part(foot, geometry, 'dark');
      const plate = new THREE.BoxGeometry(sole.ahead + sole.behind, right + left, 0.008 * scale);
      plate.translate((sole.ahead - sole.behind) / 2, (left - right) / 2, 0.004 * scale);
      plate.translate(...soleInFoot[side]);
      this.#part(foot, plate, side ? 'left' : 'right');
    });

    // Legs and arms: from each joint's link to the joints that it carries.
    const radius = { thigh: [0.062, 0.046], shank: [0.05, 0.034], upper_arm: [0.04, 0.032], forearm: [0.033, 0.026] };
    const thickness = (index) => {
      for (let at = index; at >= 0 && at !== null; at = this.joints[at].parent) {
        const name = this.joints[at].link;
        if (!name) continue;
        const kind = Object.keys(radius).find((kind) => name.endsWith(kind));
        return kind ? radius[kind].map((value) => value * scale) : [0.034 * scale, 0.034 * scale];
      }
      return [0.034 * scale, 0.034 * scale];
    };
    this.joints.forEach(({ parent, place }, index) => {
      if (index < 2 || parent === null || parent < 1 || zero(place)) return;
      if (feet.includes(parent) || parent === trunk || parent === pelvis) return;
      if (!this.joints[index].driven && /shoulder|elbow/.test(this.joints[index].name)) return;
      // Going up the right leg, a link's end is nearer to the trunk than its beginning.
      const up = this.joints[parent].name.startsWith('right') && !/shoulder|elbow/.test(this.joints[parent].name);
      const [near, far] = thickness(parent);
      this.#part(parent, limb(origin, place, up ? [far, near] : [near, far]), 'shell');
    });

    // Drives: a cylinder about the axis of a joint that stands alone, a ball where several meet.
    const meets = (index) => this.joints.some((joint, other) =>
      joint.driven && ((joint.parent === index && zero(joint.place))
        || (other === this.joints[index].parent && zero(this.joints[index].place))));
    this.joints.forEach((joint, index) => {
      if (!joint.driven || index === trunk || joint.name.startsWith('waist')) return;
      const size = (/hip|knee/.test(joint.name) ? 0.056 : /ankle/.test(joint.name) ? 0.04 : 0.046) * scale;
      if (!meets(index)) this.#part(index, drive(joint.axis, size, 1.9 * size), this.#side(index));
      else if (/pitch|shoulder|elbow/.test(joint.name)) {
        this.#part(index, drive(joint.axis, 0.9 * size, 2.5 * size), this.#side(index));
      } else if (/yaw/.test(joint.name)) this.#part(index, new THREE.SphereGeometry(1.18 * size, 28, 20), 'dark');
    });

    this.#pelvis(pelvis, scale);
    this.#trunk(trunk, scale, at);
  }

  /** A box that reaches over the hips and up to the waist. */
  #pelvis(pelvis, scale) {
    const carried = this.joints.filter(({ parent }) => parent === pelvis).map(({ place }) => place);
    const points = [new THREE.Vector3(), ...carried];
    const box = new THREE.Box3().setFromPoints(points);
    const size = box.getSize(new THREE.Vector3());
    const [depth, width] = [0.15 * scale, size.y + 0.06 * scale];
    const height = Math.max(0.13 * scale, size.z * 0.9);
    const middle = box.getCenter(new THREE.Vector3());
    const geometry = new RoundedBoxGeometry(depth, width, height, 5, 0.045 * scale);
    geometry.translate(middle.x, middle.y, Math.max(middle.z, 0) + 0.02 * scale);
    this.#part(pelvis, geometry, 'dark');
  }

  /** Waist, chest, neck and head, and the ends of the arms. */
  #trunk(trunk, scale, at) {
    const { com } = this.joints[trunk];
    const shoulders = [at('right_shoulder'), at('left_shoulder')];
    const hasArms = shoulders.every((index) => this.joints[index].driven);
    const first = this.joints[shoulders[0]].place;
    const top = Math.max(hasArms ? first.z : 1.6 * com[2], 0.12 * scale);
    const half = hasArms ? Math.max(Math.abs(first.y) - 0.045 * scale, 0.07 * scale) : 0.12 * scale;
    const low = Math.min(0.1 * scale, 0.25 * top);
    this.#part(trunk, limb(new THREE.Vector3(0, 0, -0.02 * scale), new THREE.Vector3(0, 0, 0.55 * top),
      [0.066 * scale, 0.066 * scale], 1), 'dark');
    const chest = new RoundedBoxGeometry(0.19 * scale, 2 * half, top - low + 0.05 * scale, 6, 0.06 * scale);
    // Wider at the shoulders than at the waist.
    const places = chest.attributes.position;
    for (let index = 0; index < places.count; index += 1) {
      const share = places.getZ(index) / (top - low) + 0.5;
      const factor = 0.72 + 0.28 * Math.min(1, Math.max(0, share));
      places.setY(index, places.getY(index) * factor);
      places.setX(index, places.getX(index) * (0.82 + 0.18 * share));
    }
    chest.computeVertexNormals();
    chest.translate(0, 0, (top + low) / 2 + 0.025 * scale);
    this.#part(trunk, chest, 'shell');
    const light = new RoundedBoxGeometry(0.012 * scale, 0.6 * half, 0.028 * scale, 3, 0.005 * scale);
    light.translate(0.098 * scale, 0, 0.82 * top);
    this.#part(trunk, light, 'right');
    if (!hasArms) return;

    const head = Math.max(HEAD_BY_COM * com[2], top + 0.16 * scale);
    const size = Math.min(0.09 * scale, (head - top) / 2.2);
    this.#part(trunk, limb(new THREE.Vector3(0, 0, top), new THREE.Vector3(0, 0, head - 1.6 * size),
      [0.05 * scale, 0.042 * scale], 1), 'dark');
    const skull = new RoundedBoxGeometry(1.85 * size, 1.6 * size, 2.2 * size, 7, 0.75 * size);
    skull.translate(0.1 * size, 0, head - 1.05 * size);
    this.#part(trunk, skull, 'shell');
    const visor = new RoundedBoxGeometry(0.4 * size, 1.3 * size, 0.6 * size, 5, 0.18 * size);
    visor.translate(0.87 * size, 0, head - 0.95 * size);
    this.#part(trunk, visor, 'dark');

    [['right_shoulder', 'right_elbow', 'right'], ['left_shoulder', 'left_elbow', 'left']].forEach(([upper, lower]) => {
      const [shoulder, elbow] = [at(upper), at(lower)];
      const bent = this.joints[elbow].driven;
      const last = bent ? elbow : shoulder;
      const end = new THREE.Vector3(...this.joints[last].com).multiplyScalar(HAND_BY_COM);
      if (end.length() < 0.05 * scale) return;
      const hand = end.clone().multiplyScalar(0.8);
      this.#part(last, limb(new THREE.Vector3(), hand, [0.033 * scale, 0.026 * scale]), 'shell');
      this.#part(last, limb(hand, end, [0.03 * scale, 0.026 * scale], 1.1), 'dark');
    });
  }

  /** Takes the posture between two frames. */
  pose({ before, after, share }) {
    const [a, b] = [before.base, after.base];
    this.group.position.set(...[0, 1, 2].map((axis) => a[axis] + (b[axis] - a[axis]) * share));
    const turned = ([, , , w, x, y, z]) => new THREE.Quaternion(x, y, z, w);
    this.group.quaternion.slerpQuaternions(turned(a), turned(b), share);
    this.angles = before.angles.map((angle, index) => angle + (after.angles[index] - angle) * share);
    this.joints.forEach(({ node, axis }, index) => {
      if (index > 1) node.quaternion.setFromAxisAngle(axis, this.angles[index]);
    });
  }

  /** Middle of the pelvis in the walk frame. */
  middle() {
    return this.joints[this.drawing.pelvis].node.getWorldPosition(new THREE.Vector3());
  }

  dispose() {
    this.group.traverse((object) => object.geometry?.dispose());
    Object.values(this.materials).forEach((material) => material.dispose());
  }
}
