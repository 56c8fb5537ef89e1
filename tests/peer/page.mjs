// Draws glTF files with three.js; runs in the browser. `compare.mjs` calls the functions at the end.

import * as THREE from "three";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

const renderer = new THREE.WebGLRenderer();
renderer.toneMapping = THREE.NoToneMapping;
renderer.setClearColor(0, 1);
const ktx2 = new KTX2Loader().setTranscoderPath("/three/examples/jsm/libs/basis/").detectSupport(renderer);
const loader = new GLTFLoader()
    .setDRACOLoader(new DRACOLoader().setDecoderPath("/three/examples/jsm/libs/draco/gltf/"))
    .setKTX2Loader(ktx2)
    .setMeshoptDecoder(MeshoptDecoder);

// The camera of a frame: `eye`, `target` and vertical `fov` in degrees, or else the file's first camera. Its clipping
// planes enclose the box of the scene, because Glimpse has none.
function cameraOf(gltf, { camera, bounds, width, height }) {
    const box = new THREE.Box3(new THREE.Vector3(...bounds.low), new THREE.Vector3(...bounds.high));
    const { center, radius } = box.getBoundingSphere(new THREE.Sphere());
    let lens;
    if (camera) {
        lens = new THREE.PerspectiveCamera(camera.fov);
        lens.position.set(...camera.eye);
        lens.lookAt(...camera.target);
        lens.updateMatrixWorld();
    } else {
        gltf.scene.traverse((node) => (lens ??= node.isCamera ? node : undefined));
    }
    const aspect = width / height;
    if (lens.isOrthographicCamera) {
        [lens.left, lens.right] = [-lens.top * aspect, lens.top * aspect];
    }
    lens.aspect = aspect;
    const distance = center.distanceTo(lens.getWorldPosition(new THREE.Vector3()));
    lens.near = Math.max(distance - 1.1 * radius, 1e-3 * radius);
    lens.far = distance + 1.1 * radius;
    lens.updateProjectionMatrix();
    return lens;
}

// Khronos PBR Neutral, which three.js applies to canvases alone.
function neutral(pixel) {
    const least = Math.min(...pixel);
    const offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
    const color = pixel.map((channel) => channel - offset);
    const peak = Math.max(...color);
    if (peak < 0.76) return color;
    const compressed = 1 - 0.0576 / (peak - 0.52);
    const share = 1 / (0.15 * (peak - compressed) + 1);
    return color.map((channel) => (channel * compressed / peak) * share + compressed * (1 - share));
}

function srgb(linear) {
    const c = Math.min(Math.max(linear, 0), 1);
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
}

// The picture of `sampling` x `sampling` samples of linear radiance a pixel, bottom row first: their mean, tone-mapped.
function resolved(samples, width, height, sampling) {
    const image = new ImageData(width, height);
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const sum = [0, 0, 0];
            for (let j = 0; j < sampling; j++) {
                for (let i = 0; i < sampling; i++) {
                    const row = (height - 1 - y) * sampling + j;
                    const at = 4 * (row * width * sampling + x * sampling + i);
                    for (let c = 0; c < 3; c++) sum[c] += samples[at + c];
                }
            }
            const pixel = neutral(sum.map((channel) => channel / sampling ** 2)).map(srgb);
            image.data.set([...pixel, 255], 4 * (y * width + x));
        }
    }
    return image;
}

function picture(width, height, draw) {
    const canvas = Object.assign(document.createElement("canvas"), { width, height });
    draw(canvas.getContext("2d"));
    return canvas.toDataURL("image/png");
}

// The map is dimmed by this factor and its intensity raised, because the sun in it exceeds the half floats in which
// three.js keeps filtered maps.
const DIMMED = 1 / 4;

let environment;

// Lights all further frames with an equirectangular map.
window.setEnvironment = async (url) => {
    environment = await new HDRLoader().setDataType(THREE.FloatType).loadAsync(url);
    environment.mapping = THREE.EquirectangularReflectionMapping;
    environment.image.data = environment.image.data.map((channel) => channel * DIMMED);
};

// A PNG, as a data URL, of the file at `url`.
window.drawModel = async (url, frame) => {
    const gltf = await loader.loadAsync(url);
    const scene = new THREE.Scene();
    scene.add(gltf.scene);
    scene.environment = scene.background = environment;
    scene.environmentIntensity = scene.backgroundIntensity = 1 / DIMMED;
    scene.updateMatrixWorld(true);
    scene.traverse((node) => {
        for (const material of [node.material ?? []].flat()) {
            for (const map of Object.values(material)) {
                if (map?.isTexture) map.anisotropy = renderer.capabilities.getMaxAnisotropy();
            }
        }
    });
    const { width, height, sampling } = frame;
    const [across, down] = [width * sampling, height * sampling];
    const target = new THREE.WebGLRenderTarget(across, down, { type: THREE.FloatType });
    renderer.setSize(across, down, false);
    renderer.setRenderTarget(target);
    renderer.render(scene, cameraOf(gltf, frame));
    const samples = new Float32Array(4 * across * down);
    renderer.readRenderTargetPixels(target, 0, 0, across, down, samples);
    target.dispose();
    return picture(width, height, (context) =>
        context.putImageData(resolved(samples, width, height, sampling), 0, 0));
};

// A PNG, as a data URL, of two pictures and twice their absolute difference, side by side.
window.sideBySide = async (left, right) => {
    const [a, b] = await Promise.all([left, right].map(async (url) => {
        const image = Object.assign(new Image(), { src: url });
        await image.decode();
        return image;
    }));
    return picture(3 * a.width, a.height, (context) => {
        context.drawImage(a, 0, 0);
        context.drawImage(b, a.width, 0);
        context.drawImage(a, 2 * a.width, 0);
        context.globalCompositeOperation = "difference";
        context.drawImage(b, 2 * a.width, 0);
        context.globalCompositeOperation = "lighter";
        const half = context.getImageData(2 * a.width, 0, a.width, a.height);
        half.data.forEach((value, i) => { if (i % 4 !== 3) half.data[i] = 2 * value; });
        context.putImageData(half, 2 * a.width, 0);
    });
};
