// SPDX-License-Identifier: MIT
// tactus_graph.js for Node.js, where modules are read from files. Browsers and bundlers for them do not get this file.
import { readFile } from 'node:fs/promises';
import { readFilesWith } from './tactus_graph.js';

export * from './tactus_graph.js';

readFilesWith (readFile);
