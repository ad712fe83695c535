// The viewport: floor, lights, and a camera that follows the robot.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const BACKGROUND = 0x161b22;
/** What a slow computer does without, one after the other: pixels of the screen, then shadows, then more pixels. */
const QUALITIES = [
  { pixels: 2, shadows: true }, { pixels: 1, shadows: true }, { pixels: 0.75, shadows: false },
  { pixels: 0.4, shadows: false },
];
/** Pictures over which the time between two of them is averaged, and the longest that is bearable (ms). */
const AVERAGED = 15;
const BEARABLE = 70;

/** A floor with lines every metre, and finer ones near by. */
function floor() {
  const material = new THREE.ShaderMaterial({
    uniforms: { eye: { value: new THREE.Vector3() }, scale: { value: 1 } },
    vertexShader: `varying vec3 place;
      void main() { vec4 world = modelMatrix * vec4(position, 1.0); place = world.xyz;
        gl_Position = projectionMatrix * viewMatrix * world; }`,
    fragmentShader: `varying vec3 place; uniform vec3 eye; uniform float scale;
      float lines(float every, float width) {
        vec2 at = place.xy / every;
        vec2 away = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), vec2(1e-6));
        return (1.0 - min(min(away.x, away.y) / width, 1.0));
      }
      void main() {
        float far = length(place.xy - eye.xy) / scale;
        float fade = exp(-far * far / 160.0);
        vec3 ground = mix(vec3(0.0080, 0.0108, 0.0150), vec3(0.026, 0.033, 0.043), fade);
        float fine = lines(0.1 * scale, 1.0) * 0.10 * exp(-far * far / 14.0);
        float coarse = lines(1.0, 1.3) * 0.42 * fade;
        gl_FragColor = vec4(mix(ground, vec3(0.20, 0.27, 0.35), max(fine, coarse)), 1.0);
        #include <colorspace_fragment>
      }`,
  });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2000, 2000), material);
  mesh.position.z = -0.0015;
  mesh.name = 'floor';
  return mesh;
}

export class Viewport {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.15;
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(BACKGROUND);
    this.scene.fog = new THREE.Fog(BACKGROUND, 14, 42);
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.02, 200);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(2.6, -2.9, 1.55);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.set(0, 0, 0.75);
    this.controls.enableDamping = true;
    this.controls.maxPolarAngle = Math.PI / 2 - 0.02;
    this.controls.minDistance = 0.4;
    this.controls.maxDistance = 30;

    this.floor = floor();
    const shadows = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), new THREE.ShadowMaterial({ opacity: 0.42 }));
    shadows.receiveShadow = true;
    shadows.renderOrder = 1;
    shadows.material.depthWrite = false;
    this.shadows = shadows;
    this.sun = new THREE.DirectionalLight(0xfff2e0, 2.7);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.02;
    this.rim = new THREE.DirectionalLight(0x86b8ff, 1.3);
    this.scene.add(this.floor, shadows, this.sun, this.sun.target, this.rim, this.rim.target,
      new THREE.HemisphereLight(0xcfe0f5, 0x2a2f38, 1.35));
    this.follow = null;
    this.shape = null;
    this.size = 1;
    this.left = 0;
    this.times = [];
    this.setQuality(0);
    this.resize();
    addEventListener('resize', () => this.resize());
  }

  /** Fits the viewport to a robot: `size` is 1 for one of the paper's size. */
  fit(size) {
    const ratio = size / this.size;
    this.size = size;
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(ratio);
    this.controls.target.multiplyScalar(ratio);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.minDistance = 0.4 * size;
    const { camera } = this.sun.shadow;
    const [side, end] = [1.5 * size, 1.8 * size];
    Object.assign(camera, { left: -side, right: side, top: end, bottom: -end, near: 0.1, far: 12 * size });
    camera.updateProjectionMatrix();
    this.floor.material.uniforms.scale.value = size;
    this.scene.fog.near = 14 * size;
    this.scene.fog.far = 42 * size;
  }

  /** Fits the picture to the window. Its middle is that of what the panels to the left and to the right leave free. */
  resize(left = this.left) {
    this.left = left;
    const panel = innerWidth > 900 ? 380 - left : 0;
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    this.camera.setViewOffset(innerWidth, innerHeight, panel / 2, 0, innerWidth, innerHeight);
    this.camera.updateProjectionMatrix();
  }

  /** Moves camera and light with the robot; some seconds have passed. */
  track(middle, seconds) {
    const height = Math.max(0.62 * this.size, 0.86 * Math.min(middle.z, 0.95 * this.size));
    const target = new THREE.Vector3(middle.x, middle.y, height);
    if (this.follow) {
      const step = target.clone().sub(this.follow);
      const jumps = step.length() > 1.5 * this.size;
      const share = jumps ? 1 : 1 - Math.exp(-8 * seconds);
      step.multiplyScalar(share);
      this.follow.add(step);
      this.camera.position.add(step);
      this.controls.target.add(step);
    } else {
      const step = target.clone().sub(this.controls.target);
      this.camera.position.add(step);
      this.controls.target.copy(target);
      this.follow = target.clone();
    }
    const { size } = this;
    this.sun.target.position.copy(this.follow);
    this.sun.position.copy(this.follow).add(new THREE.Vector3(1.6, -1.9, 4.2).multiplyScalar(size));
    this.rim.target.position.copy(this.follow);
    this.rim.position.copy(this.follow).add(new THREE.Vector3(-3, 2.4, 1.6).multiplyScalar(size));
    this.shadows.position.set(this.follow.x, this.follow.y, 0);
  }

  /** Sets how much is drawn: 0 is all of it. */
  setQuality(level) {
    this.quality = Math.min(level, QUALITIES.length - 1);
    const { pixels, shadows } = QUALITIES[this.quality];
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, pixels));
    this.renderer.shadowMap.enabled = shadows;
    this.sun.castShadow = shadows;
    this.times = [];
  }

  /** Draws less if pictures take too long. */
  #adapt() {
    const now = performance.now();
    const last = this.times[this.times.length - 1];
    // A page that was hidden was not slow.
    if (now - last > 2000) this.times = [];
    this.times.push(now);
    if (this.times.length <= AVERAGED) return;
    const mean = (now - this.times.shift()) / AVERAGED;
    if (mean > BEARABLE && this.quality < QUALITIES.length - 1) this.setQuality(this.quality + 1);
  }

  draw() {
    this.#adapt();
    this.controls.update();
    this.floor.material.uniforms.eye.value.copy(this.controls.target);
    this.renderer.render(this.scene, this.camera);
  }

  /** The ray through a point of the window. */
  ray(event) {
    const at = new THREE.Vector2((event.clientX / innerWidth) * 2 - 1, 1 - (event.clientY / innerHeight) * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    return ray;
  }

  /** Shows the floor as a plane, or a shape in place of it. */
  showFloor(shape) {
    this.shape = shape;
    this.floor.visible = this.shadows.visible = shape === null;
  }

  /** The point of the floor under a point of the window; null above the horizon. */
  floorAt(event) {
    const [hit] = this.shape ? this.ray(event).intersectObject(this.shape.ground) : [];
    if (hit) return hit.point;
    return this.ray(event).ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), 0), new THREE.Vector3());
  }
}
