// SPDX-License-Identifier: MIT
// node run_wasi.cjs PROGRAM.wasm: runs a program for WASI.
'use strict';
const { WASI } = require ('wasi');
const wasi = new WASI ({ version: 'preview1', args: [process.argv[2]], returnOnExit: true });
const module_ = new WebAssembly.Module (require ('fs').readFileSync (process.argv[2]));
process.exitCode = wasi.start (new WebAssembly.Instance (module_, { wasi_snapshot_preview1: wasi.wasiImport }));
