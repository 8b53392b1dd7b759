// SPDX-License-Identifier: Apache-2.0
// @ts-check
// From the bytes of a GLB to a model. A decoder is loaded when the first file asks for it, from beside this script.
import { Sphere, Vector3 } from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Model } from './model.js';

const WORKERS = 2;

/** Whether the file's JSON names the extension. @param {ArrayBuffer} bytes @param {string} extension */
function asksFor(bytes, extension) {
  const head = new DataView(bytes);
  if (bytes.byteLength < 20 || head.getUint32(0, true) !== 0x46546c67) return false;
  const json = new Uint8Array(bytes, 20, Math.min(head.getUint32(12, true), bytes.byteLength - 20));
  return new TextDecoder().decode(json).includes(`"${extension}"`);
}

export class Decoder {
  #gltf = new GLTFLoader();
  #draco = new DRACOLoader().setWorkerLimit(WORKERS);
  #folder;
  #dracoReady = false;
  #meshoptReady = false;

  /** @param {string} folder  address of the folder that holds draco/ and meshopt.js */
  constructor(folder) {
    this.#folder = folder;
    this.#draco.setDecoderPath(new URL('draco/', folder).href);
    this.#gltf.setDRACOLoader(this.#draco);
  }

  /** @param {ArrayBuffer} bytes */
  async #prepare(bytes) {
    if (!this.#dracoReady && asksFor(bytes, 'KHR_draco_mesh_compression')) {
      await /** @type {any} */ (this.#draco.preload()).decoderPending;
      this.#dracoReady = true;
    }
    if (!this.#meshoptReady && asksFor(bytes, 'EXT_meshopt_compression')) {
      const { MeshoptDecoder } = await import(new URL('meshopt.js', this.#folder).href);
      this.#gltf.setMeshoptDecoder(MeshoptDecoder);
      this.#meshoptReady = true;
    }
  }

  /**
   * @param {ArrayBuffer} bytes
   * @param {number[] | null} sphere  x, y, z and radius
   */
  async model(bytes, sphere) {
    await this.#prepare(bytes);
    const start = performance.now();
    const { scene } = await this.#gltf.parseAsync(bytes, '');
    const about = sphere && new Sphere(new Vector3(sphere[0], sphere[1], sphere[2]), sphere[3]);
    return new Model(scene, about, performance.now() - start);
  }
}
