// SPDX-License-Identifier: Apache-2.0
// Runs in the browser, beside page.mjs: originals as other viewers should be given them, and how far two pictures are apart.
import { DoubleSide } from 'three';
import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

// The GLB as the measure draws it, where glTF would not: with smooth normals if it has none, and from both sides. A data: address.
window.asMeasured = async (url) => {
  const { scene } = await new GLTFLoader().loadAsync(url);
  scene.traverse(({ geometry, material }) => {
    if (!geometry) return;
    if (!geometry.attributes.normal) geometry.computeVertexNormals();
    Object.assign(material, { flatShading: false, side: DoubleSide });
  });
  const bytes = await new GLTFExporter().parseAsync(scene, { binary: true });
  return new Promise((done) => {
    const reader = Object.assign(new FileReader(), { onload: () => done(reader.result) });
    reader.readAsDataURL(new Blob([bytes]));
  });
};

// A picture over white, each block of `times` x `times` pixels averaged.
async function reduced(url, times) {
  const image = Object.assign(new Image(), { src: url });
  await image.decode();
  const side = image.width / times;
  const context = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height }).getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.width, image.height);
  const sums = new Float64Array(3 * side * side);
  for (let i = 0; i < data.length; ++i) {
    const pixel = i >> 2, x = Math.floor((pixel % image.width) / times), y = Math.floor(pixel / image.width / times);
    if (i % 4 < 3) sums[3 * (y * side + x) + (i % 4)] += data[i] / (times * times);
  }
  return sums.map(Math.round);
}

// Mean square error times 10^4 of two screenshots, and the share of pixels that are not white.
window.apart = async (a, b, times) => {
  const [left, right] = await Promise.all([reduced(a, times), reduced(b, times)]);
  let sum = 0, filled = 0;
  for (let i = 0; i < left.length; ++i) sum += ((left[i] - right[i]) / 255) ** 2;
  for (let i = 0; i < left.length; i += 3) filled += left[i] + left[i + 1] + left[i + 2] < 750;
  return { mse1e4: (1e4 * sum) / left.length, filled: filled / (left.length / 3) };
};
