// SPDX-License-Identifier: Apache-2.0
// @ts-check
// A thumbnail as the stage draws it: its meshes in the materials of the three modes, and what it takes to see all of it.
import { Box3, DoubleSide, Mesh, MeshNormalMaterial, MeshStandardMaterial, Sphere, Vector3 } from 'three';

/** @typedef {'shaded' | 'white' | 'normals'} Mode */

// Linear base colours of what has none: objects that were scanned without colour, as they are measured, and plaster for white mode.
const GREY = 0.5, WHITE = 0.8;

/** @param {import('three').Object3D} root @returns {Mesh[]} */
function meshesOf(root) {
  /** @type {Mesh[]} */
  const meshes = [];
  root.traverse((node) => { if (node instanceof Mesh) meshes.push(node); });
  return meshes;
}

/** About the middle of the box, out to the farthest vertex. @param {Mesh[]} meshes */
function sphereAbout(meshes) {
  const box = new Box3();
  for (const mesh of meshes) box.expandByObject(mesh, true);
  const centre = box.getCenter(new Vector3()), vertex = new Vector3();
  let radius = 0;
  for (const { geometry, matrixWorld } of meshes) {
    const places = geometry.attributes.position;
    for (let i = 0; i < places.count; ++i) radius = Math.max(radius, vertex.fromBufferAttribute(places, i).applyMatrix4(matrixWorld).distanceTo(centre));
  }
  return new Sphere(centre, radius || 1);
}

/** As it was measured: matt, seen from both sides; grey where the file says no colour. @param {any} material */
function settle(material) {
  material.side = DoubleSide;
  if (!material.isMeshStandardMaterial) return material;
  material.roughness = 1;
  material.metalness = 0;
  if (!material.map && !material.vertexColors && material.color.getHex() === 0xffffff) material.color.setScalar(GREY);
  return material;
}

/** @param {any} shaded @param {Mode} mode */
function materialFor(shaded, mode) {
  const { normalMap, normalScale, flatShading = false } = shaded;
  const shape = { flatShading, side: DoubleSide, ...(normalMap && { normalMap, normalScale }) };
  if (mode === 'normals') return new MeshNormalMaterial(shape);
  const white = new MeshStandardMaterial({ ...shape, aoMap: shaded.aoMap ?? null, roughness: 1, metalness: 0 });
  white.color.setScalar(WHITE);
  return white;
}

export class Model {
  #meshes;
  #shaded;
  /** @type {Map<Mode, any[]>} */
  #materials = new Map();

  /**
   * @param {import('three').Object3D} root  as the loader made it
   * @param {Sphere | null} sphere  about the original, where that is known
   * @param {number} milliseconds  that decoding took
   */
  constructor(root, sphere, milliseconds) {
    root.updateMatrixWorld(true);
    this.root = root;
    this.milliseconds = milliseconds;
    this.#meshes = meshesOf(root);
    this.#shaded = this.#meshes.map((mesh) => settle(mesh.material));
    this.#materials.set('shaded', this.#shaded);
    this.sphere = sphere ?? sphereAbout(this.#meshes);
  }

  get triangles() {
    return this.#meshes.reduce((sum, { geometry }) => sum + (geometry.index ?? geometry.attributes.position).count / 3, 0);
  }

  /** @param {Mode} mode */
  dress(mode) {
    const made = this.#materials.get(mode) ?? this.#shaded.map((material) => materialFor(material, mode));
    this.#materials.set(mode, made);
    this.#meshes.forEach((mesh, i) => { mesh.material = made[i]; });
  }

  /** Gives all memory back. */
  dispose() {
    for (const mesh of this.#meshes) mesh.geometry.dispose();
    for (const material of this.#shaded)
      for (const value of Object.values(material))
        if (value?.isTexture) {
          value.dispose();
          value.source.data?.close?.();
        }
    for (const materials of this.#materials.values()) for (const material of materials) material.dispose();
  }
}
