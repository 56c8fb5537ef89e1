// Draws the models of a conformance pack with Glimpse and with three.js and measures how they differ. See README.md.

import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, resolve } from "node:path";
import { parseArgs, promisify } from "node:util";
import { chromium } from "playwright-core";

const here = import.meta.dirname;
const run = promisify(execFile);
const SAMPLING = 3;
const LONGER_SIDE = 384;
const LIMITS = [0.05, 0.1, 0.15, 0.2, 0.25];

const { values: options } = parseArgs({
    options: {
        pack: { type: "string", default: resolve(here, "../../../shared/conformance") },
        glimpse: { type: "string", default: resolve(here, "../../target/release/glimpse") },
        environment: { type: "string", default: "chinese_garden_1k.hdr" },
        only: { type: "string", default: "" },
        out: { type: "string", default: "peer" },
        browser: { type: "string", default: "/usr/bin/chromium" },
    },
});

// Paths of the models, within the pack's folder of models.
async function models() {
    const folder = join(options.pack, "models");
    const files = await readdir(folder, { recursive: true });
    return files.filter((file) => [".glb", ".gltf"].includes(extname(file)) && file.includes(options.only)).sort();
}

// Serves this folder, three.js and the pack to the browser.
async function serve() {
    const roots = { three: join(here, "node_modules/three"), pack: options.pack, page: here };
    const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
    const server = createServer(async (request, response) => {
        const [, root, ...rest] = decodeURIComponent(new URL(request.url, "http://localhost").pathname).split("/");
        try {
            const body = await readFile(join(roots[root], ...rest));
            response.setHeader("content-type", types[extname(rest.at(-1))] ?? "application/octet-stream");
            response.end(body);
        } catch {
            response.writeHead(404).end();
        }
    });
    await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
    return { server, address: `http://127.0.0.1:${server.address().port}` };
}

// Size and camera of a model's frame: the scenario's, else the file's own camera, else Glimpse's framing one.
function frameOf(scenario, info) {
    const frame = { width: LONGER_SIDE, height: LONGER_SIDE, sampling: SAMPLING, bounds: info.bounds };
    if (scenario) {
        const [width, height] = scenario.size.map((side) => (LONGER_SIDE * side) / Math.max(...scenario.size));
        const { theta, phi, radius } = scenario.orbit;
        const [t, p] = [theta, phi].map((degrees) => (degrees * Math.PI) / 180);
        const back = [Math.sin(p) * Math.sin(t), Math.cos(p), Math.sin(p) * Math.cos(t)];
        const eye = scenario.target.map((at, i) => at + radius * back[i]);
        const camera = { eye, target: scenario.target, fov: scenario.vertical_fov };
        return { ...frame, width: Math.round(width), height: Math.round(height), camera };
    }
    const [{ name, origin, forward }] = info.cameras;
    if (name !== "framing") return frame;
    const target = origin.map((at, i) => at + forward[i] * Math.hypot(...origin));
    return { ...frame, camera: { eye: origin, target, fov: 45 } };
}

async function drawOurs(file, frame, environment, out) {
    const { camera } = frame;
    const view = camera ? [`--eye=${camera.eye}`, `--target=${camera.target}`, `--fov=${camera.fov}`] : [];
    const { stderr } = await run(options.glimpse, [
        "render", file, "-o", out, "--size", `${frame.width}x${frame.height}`, ...view,
        "--environment", environment, "--tonemap", "neutral", "--exposure", "0",
        "--method", "full", "--sampling", `${SAMPLING}`,
    ]);
    return stderr.split("\n").filter((line) => line.includes("not shown:")).map((line) => line.replace("glimpse: ", ""));
}

const PNG_URL = "data:image/png;base64,";

async function compareModel(page, model, scenario) {
    const file = join(options.pack, "models", model);
    const name = model.split("/").at(-1).replace(/\.\w+$/, "");
    const [ours, theirs] = ["glimpse", "three"].map((by) => join(options.out, `${name}.${by}.png`));
    const info = JSON.parse((await run(options.glimpse, ["info", "--json", file])).stdout);
    const frame = frameOf(scenario, info);
    const environment = join(options.pack, "environments", options.environment);
    const told = await drawOurs(file, frame, environment, ours);
    if (!existsSync(theirs)) {
        const url = `/pack/models/${model.split("/").map(encodeURIComponent).join("/")}`;
        const drawn = await page.evaluate(([u, f]) => window.drawModel(u, f), [url, frame]);
        await writeFile(theirs, Buffer.from(drawn.replace(PNG_URL, ""), "base64"));
    }
    const urls = await Promise.all([ours, theirs].map(async (png) => PNG_URL + (await readFile(png, "base64"))));
    const sheet = await page.evaluate(([a, b]) => window.sideBySide(a, b), urls);
    await writeFile(join(options.out, `${name}.png`), Buffer.from(sheet.replace(PNG_URL, ""), "base64"));
    const error = JSON.parse((await run(options.glimpse, ["compare", "--json", ours, theirs])).stdout);
    return { name, flip: error.flip_mean, lights: info.lights, told };
}

function table(rows) {
    const drawn = rows.filter((row) => row.flip !== undefined).sort((a, b) => b.flip - a.flip);
    const alone = drawn.filter((row) => row.lights === 0);
    const median = alone[alone.length >> 1]?.flip.toFixed(3);
    const shares = LIMITS.map((limit) => `${alone.filter((row) => row.flip > limit).length} above ${limit}`);
    return [
        `Mean FLIP of Glimpse against three.js, ${options.environment}. Lit by the environment alone: ${alone.length} models,`,
        `median ${median}, ${shares.join(", ")}.`,
        "",
        "| model | mean FLIP | lights in the file | Glimpse says |",
        "| --- | ---: | ---: | --- |",
        ...drawn.map(({ name, flip, lights, told }) => `| ${name} | ${flip.toFixed(3)} | ${lights} | ${told.join(" ")} |`),
        ...rows.filter((row) => row.failed).map(({ name, failed }) => `| ${name} | - | | ${failed} |`),
        "",
    ].join("\n");
}

await mkdir(options.out, { recursive: true });
const { scenarios } = JSON.parse(await readFile(join(options.pack, "scenarios.json")));
const { server, address } = await serve();
const browser = await chromium.launch({
    executablePath: options.browser,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
        "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});
const page = await browser.newPage();
page.on("console", (message) => console.error(`three.js: ${message.text()}`));
await page.goto(`${address}/page/page.html`);
await page.waitForFunction(() => window.drawModel);
await page.evaluate((url) => window.setEnvironment(url), `/pack/environments/${options.environment}`);
const rows = [];
for (const model of await models()) {
    const scenario = scenarios.find((each) => each.model === model.split("/").at(-1));
    try {
        rows.push(await compareModel(page, model, scenario));
    } catch (error) {
        const failed = (error.stderr || error.message).trim().split("\n").at(-1);
        rows.push({ name: model, failed });
    }
    console.error(JSON.stringify(rows.at(-1)));
}
await writeFile(join(options.out, "table.md"), table(rows));
console.log(table(rows));
await browser.close();
server.close();
