#!/usr/bin/env node
// Meshes of height maps by delatin and @mapbox/martini (both ISC, from npm) under Node, for `limn bench terrain`, which runs this program
// where it finds it. The packages are looked for beside it: npm install --prefix build/bench delatin @mapbox/martini
//
// grid_meshes METHOD HEIGHTS SIDE RUNS MESH PARAMETER...
//   METHOD   delatin or martini
//   HEIGHTS  SIDE x SIDE floats, little-endian, row by row
//   RUNS     how often each parameter is timed, after one run that does not count
//   MESH     where meshes go: MESH.0.ply and so on, one for each parameter, x the column and y the row
// Prints JSON: {"setup_ms": n, "rows": [{"ms": [...], "triangles": n}, ...]}

'use strict';
const fs = require('fs');

function median(times) {
    const sorted = [...times].sort((a, b) => a - b);
    return sorted[sorted.length >> 1];
}

/// @returns the result of the last run, and milliseconds of each
function timed(runs, f) {
    const ms = [];
    let result = f();
    for (let run = 0; run < runs; ++run) {
        const start = process.hrtime.bigint();
        result = f();
        ms.push(Number(process.hrtime.bigint() - start) / 1e6);
    }
    return {ms, result};
}

function writeMesh(path, heights, side, vertices, triangles) {
    const count = vertices.length / 2, faces = triangles.length / 3;
    const header = Buffer.from(`ply\nformat binary_little_endian 1.0\nelement vertex ${count}\nproperty float x\nproperty float y\nproperty float z\n` +
                               `element face ${faces}\nproperty list uchar uint vertex_indices\nend_header\n`);
    const body = Buffer.alloc(12 * count + 13 * faces);
    let at = 0;
    for (let v = 0; v < count; ++v) {
        const x = vertices[2 * v], y = vertices[2 * v + 1];
        at = body.writeFloatLE(x, at);
        at = body.writeFloatLE(y, at);
        at = body.writeFloatLE(heights[y * side + x], at);
    }
    for (let f = 0; f < faces; ++f) {
        at = body.writeUInt8(3, at);
        for (let k = 0; k < 3; ++k)
            at = body.writeUInt32LE(triangles[3 * f + k], at);
    }
    fs.writeFileSync(path, Buffer.concat([header, body]));
}

async function meshers(method, heights, side, runs) {
    if (method === 'delatin') {
        const Delatin = (await import('delatin')).default;
        return {setup_ms: 0, mesh: (parameter) => {
            const tin = new Delatin(heights, side, side);
            tin.run(parameter);
            return {vertices: tin.coords, triangles: tin.triangles};
        }};
    }
    const Martini = (await import('@mapbox/martini')).default;
    const setup = timed(runs, () => new Martini(side).createTile(heights));
    return {setup_ms: median(setup.ms), mesh: (parameter) => setup.result.getMesh(parameter)};
}

async function main([method, file, sideText, runsText, prefix, ...parameters]) {
    const side = Number(sideText), runs = Number(runsText);
    const bytes = fs.readFileSync(file);
    const heights = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
    const {setup_ms, mesh} = await meshers(method, heights, side, runs);
    const rows = parameters.map((parameter, i) => {
        const {ms, result} = timed(runs, () => mesh(Number(parameter)));
        writeMesh(`${prefix}.${i}.ply`, heights, side, result.vertices, result.triangles);
        return {ms, triangles: result.triangles.length / 3};
    });
    console.log(JSON.stringify({setup_ms, rows}));
}

main(process.argv.slice(2)).catch((error) => {
    console.error(`grid_meshes: ${error.message}`);
    process.exitCode = 1;
});
