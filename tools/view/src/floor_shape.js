// The floor where it is no plane: its pieces near the robot, as they lie in the walk frame.
import * as THREE from 'three';

const COLOUR = 0x36424f;
/** What the floor looks like where a sole slips easily: less friction, more of it. */
const SLIPPERY = 0x4a6f96;
/** Friction from which on nothing is marked as slippery (-). */
const FIRM = 0.7;
/** How far the sides of steps reach below the lowest piece (m). */
const BELOW = 0.02;

const bucketOf = (x, y) => `${Math.floor(x)} ${Math.floor(y)}`;

/** The plane of a piece: a point and the unit normal. */
function planeOf(corners) {
  const normal = new THREE.Vector3();
  corners.forEach(([x, y, z], index) => {
    const [nextX, nextY, nextZ] = corners[(index + 1) % corners.length];
    normal.x += (y - nextY) * (z + nextZ);
    normal.y += (z - nextZ) * (x + nextX);
    normal.z += (x - nextX) * (y + nextY);
  });
  return { corners, at: corners[0], normal: normal.normalize() };
}

const covers = (corners, x, y) => corners.every(([ax, ay], index) => {
  const [bx, by] = corners[(index + 1) % corners.length];
  return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= -1e-6;
});

export class FloorShape {
  constructor() {
    this.group = new THREE.Group();
    this.group.visible = false;
    this.ground = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshStandardMaterial({
      vertexColors: true, roughness: 0.95, metalness: 0, side: THREE.DoubleSide,
    }));
    this.ground.receiveShadow = true;
    this.ground.name = 'floor shape';
    this.edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({
      color: 0x6b7f95, transparent: true, opacity: 0.55,
    }));
    this.group.add(this.ground, this.edges);
    this.buckets = new Map();
    this.origin = null;
  }

  /** Replaces all pieces. */
  set(pieces) {
    const [places, colours, lines] = [[], [], []];
    const lowest = Math.min(...pieces.flatMap(({ corners }) => corners.map(([, , z]) => z))) - BELOW;
    this.buckets = new Map();
    const colour = new THREE.Color();
    const add = (corner) => {
      places.push(...corner);
      colours.push(colour.r, colour.g, colour.b);
    };
    pieces.forEach(({ corners, friction }) => {
      const share = Math.min(1, Math.max(0, 1 - friction / FIRM));
      colour.set(COLOUR).lerp(new THREE.Color(SLIPPERY), share);
      for (let index = 2; index < corners.length; index += 1) {
        [corners[0], corners[index - 1], corners[index]].forEach(add);
      }
      corners.forEach((a, index) => {
        const b = corners[(index + 1) % corners.length];
        const [c, d] = [[b[0], b[1], lowest], [a[0], a[1], lowest]];
        [a, d, c, a, c, b].forEach(add);
        lines.push(...a, ...b);
      });
      const plane = planeOf(corners);
      // A piece lies in one square of a metre: that of its middle.
      const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
      const bucket = bucketOf(...middle);
      if (!this.buckets.has(bucket)) this.buckets.set(bucket, []);
      this.buckets.get(bucket).push(plane);
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours, 3));
    geometry.computeVertexNormals();
    const outline = new THREE.BufferGeometry();
    outline.setAttribute('position', new THREE.Float32BufferAttribute(lines, 3));
    this.ground.geometry.dispose();
    this.edges.geometry.dispose();
    this.ground.geometry = geometry;
    this.edges.geometry = outline;
  }

  /** Puts the floor where a frame has it; it is hidden where the frame has none. */
  place(frame) {
    this.origin = this.buckets.size ? frame.floor ?? null : null;
    this.group.visible = this.origin !== null;
    if (!this.origin) return;
    const [x, y, heading, z] = this.origin;
    this.group.position.set(x, y, z);
    this.edges.position.z = 0.001;
    this.group.rotation.set(0, 0, heading);
  }

  /** Height and unit normal of the floor at a place in the walk frame (m). */
  at(x, y) {
    if (!this.origin) return { height: 0, normal: null };
    const [x0, y0, heading, z0] = this.origin;
    const [c, s] = [Math.cos(heading), Math.sin(heading)];
    const [wx, wy] = [c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0)];
    const plane = this.buckets.get(bucketOf(wx, wy))?.find(({ corners }) => covers(corners, wx, wy));
    if (!plane) return { height: z0, normal: null };
    const { at, normal } = plane;
    const height = at[2] - (normal.x * (wx - at[0]) + normal.y * (wy - at[1])) / normal.z;
    const turned = new THREE.Vector3(c * normal.x - s * normal.y, s * normal.x + c * normal.y, normal.z);
    return { height: height + z0, normal: turned };
  }

  dispose() {
    this.ground.geometry.dispose();
    this.edges.geometry.dispose();
  }
}
