// SPDX-License-Identifier: Apache-2.0
// Runs in the browser: draws one GLB and says what is to be seen.
import * as THREE from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const SIDE = 250; // pixels
const EDGE = 2.5; // of the square that the camera sees, in model units

const renderer = new THREE.WebGLRenderer({ alpha: true, preserveDrawingBuffer: true });
renderer.setSize(SIDE, SIDE, false);
renderer.setClearColor(0, 0); // alpha tells background from model
const loader = new GLTFLoader()
  .setDRACOLoader(new DRACOLoader().setDecoderPath('/three/examples/jsm/libs/draco/gltf/'))
  .setMeshoptDecoder(MeshoptDecoder);

// Orthographic, along -z, at `centre`; light of irradiance pi from the direction `light`, or from everywhere.
function stage(root, { centre, edge, light }) {
  const scene = new THREE.Scene().add(root);
  const camera = new THREE.OrthographicCamera(-edge / 2, edge / 2, edge / 2, -edge / 2, 0.1 * edge, 4 * edge);
  camera.position.set(...centre).z += 2 * edge;
  if (light) {
    const sun = new THREE.DirectionalLight(0xffffff, Math.PI);
    sun.target.position.set(...centre);
    sun.position.set(...centre).addScaledVector(new THREE.Vector3(...light), edge);
    scene.add(sun, sun.target);
  } else {
    scene.add(new THREE.AmbientLight(0xffffff, Math.PI));
  }
  return { scene, camera };
}

// Draws; returns the share of pixels covered, and the colours at `places`, from -1 to 1 in half the seen square's edge of 2.5.
function look({ scene, camera }, places) {
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * SIDE * SIDE);
  gl.readPixels(0, 0, SIDE, SIDE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let covered = 0;
  for (let i = 3; i < pixels.length; i += 4) if (pixels[i] > 0) covered++;
  const colours = places.map((place) => {
    const [x, y] = place.map((p) => Math.floor((p / EDGE + 0.5) * SIDE));
    return [...pixels.slice(4 * (y * SIDE + x), 4 * (y * SIDE + x) + 3)];
  });
  return { coverage: covered / (SIDE * SIDE), colours };
}

function meshes(root) {
  const found = [];
  root.traverse((object) => { if (object.isMesh) found.push(object); });
  return found;
}

// The same surface with `normal` at each vertex in place of its normal map.
function showGeometric(root, normal) {
  for (const { geometry, material } of meshes(root)) {
    const values = new Float32Array(3 * geometry.attributes.position.count).map((_, i) => normal[i % 3]);
    geometry.setAttribute('normal', new THREE.BufferAttribute(values, 3));
    Object.assign(material, { normalMap: null, flatShading: false, needsUpdate: true });
  }
}

// A picture as RGBA bytes, row by row from the top.
async function pixelsOf(url) {
  const image = new Image();
  image.src = url;
  await image.decode();
  const context = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height }).getContext('2d');
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, image.width, image.height).data;
}

// The model in perspective, from the front and 10 degrees above, where its sphere just fits; lit from the camera.
async function portrait(url) {
  const { scene: root } = await loader.loadAsync(url);
  const box = new THREE.Box3().setFromObject(root, true);
  const centre = box.getCenter(new THREE.Vector3());
  let radius = 0;
  const place = new THREE.Vector3();
  for (const { geometry, matrixWorld } of meshes(root))
    for (let i = 0; i < geometry.attributes.position.count; ++i)
      radius = Math.max(radius, place.fromBufferAttribute(geometry.attributes.position, i).applyMatrix4(matrixWorld).distanceTo(centre));
  const rise = Math.PI / 18, distance = radius / Math.sin(Math.PI / 12);
  const camera = new THREE.PerspectiveCamera(30, 1, distance - 1.5 * radius, distance + 1.5 * radius);
  camera.position.set(0, Math.sin(rise), Math.cos(rise)).multiplyScalar(distance).add(centre);
  camera.lookAt(centre);
  const sun = new THREE.DirectionalLight(0xffffff, Math.PI);
  sun.position.copy(camera.position);
  sun.target.position.copy(centre);
  const scene = new THREE.Scene().add(root, sun, sun.target);
  renderer.render(scene, camera);
  return pixelsOf(renderer.domElement.toDataURL());
}

// Whether a silhouette, given as a test of pixels, has a pixel at i or beside it.
function near(inside, i, side) {
  for (let y = -1; y <= 1; ++y) for (let x = -1; x <= 1; ++x) if (inside(i + 4 * (y * side + x))) return true;
  return false;
}

// How a screenshot of SIDE x SIDE pixels, its background magenta, differs from the portrait of a GLB: overlap of the silhouettes, whose
// edges may be a pixel apart (one of the pictures is antialiased, and thin things are all edge), and the mean difference of the
// colours where both show the model, signed and not.
window.against = async (screenshot, url) => {
  const [shown, wanted] = [await pixelsOf(screenshot), await portrait(url)];
  const side = Math.sqrt(wanted.length / 4);
  const isHere = (i) => i in shown && !(shown[i] > 250 && shown[i + 1] < 5 && shown[i + 2] > 250), isThere = (i) => wanted[i + 3] > 127;
  let [overlap, both, either, bias, error] = [0, 0, 0, 0, 0];
  for (let i = 0; i < wanted.length; i += 4) {
    const here = isHere(i), there = isThere(i);
    either += here || there;
    overlap += here ? near(isThere, i, side) : there && near(isHere, i, side);
    if (!here || !there) continue;
    ++both;
    for (let k = 0; k < 3; ++k) {
      bias += (shown[i + k] - wanted[i + k]) / 3;
      error += Math.abs(shown[i + k] - wanted[i + k]) / 3;
    }
  }
  return { overlap: overlap / either, share: either / (wanted.length / 4), bias: bias / both, error: error / both };
};

// `centre` left out: the camera looks at the middle of the model's box, and its sphere just fits.
window.draw = async (url, { centre, light, places = [], geometric = null }) => {
  const { scene: root } = await loader.loadAsync(url);
  const sphere = new THREE.Box3().setFromObject(root).getBoundingSphere(new THREE.Sphere());
  const view = centre ? { centre, edge: EDGE, light } : { centre: sphere.center.toArray(), edge: 2 * sphere.radius, light };
  const staged = stage(root, view);
  const seen = look(staged, places);
  const triangles = renderer.info.render.triangles;
  let wanted = null;
  if (geometric) {
    showGeometric(root, geometric);
    wanted = look(staged, places).colours;
  }
  return { ...seen, wanted, triangles, radius: sphere.radius };
};
