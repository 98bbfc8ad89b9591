// `npm pack` takes every file of the package: scripts, types, the page, and bodice in WebAssembly where it is built.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {readdirSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';

const web = process.env.BODICE_WEB;
const files = (folder = '') => readdirSync(path.join(web, folder), {withFileTypes: true}).flatMap(entry => {
  const name = path.posix.join(folder, entry.name);
  return entry.isDirectory() ? files(name) : [name];
});
const hasNpm = (() => {
  try {
    return !!execFileSync('npm', ['--version'], {stdio: 'pipe'});
  } catch {
    return false;
  }
})();

test('npm pack takes every script, type and page of the package', {skip: hasNpm ? false : 'npm is not installed'}, () => {
  const [{files: packed}] = JSON.parse(execFileSync('npm', ['pack', '--dry-run', '--json', '--offline'],
                                                    {cwd: web, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}));
  const wanted = files().filter(name => /\.(mjs|d\.ts|html|css|wasm|json)$/.test(name));
  assert.ok(wanted.includes('page/index.html') && wanted.includes('bodice.d.ts'));
  assert.deepEqual(packed.map(file => file.path).sort(), wanted.sort());
});
