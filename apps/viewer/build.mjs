// Makes the viewer: one HTML page with script, style and licenses in it, and a place for the data;
// and the same as a C++ string.
//
// Usage: node build.mjs FOLDER OUT.html OUT.cpp, where npm ci was run in FOLDER
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [folder, htmlPath, cppPath] = process.argv.slice(2);
const modules = join(folder, 'node_modules');
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const { buildSync } = createRequire(join(folder, 'package.json'))('esbuild');
const read = (name) => readFileSync(join(source, name), 'utf8');

const script = buildSync({
  entryPoints: [join(source, 'main.js')],
  nodePaths: [modules],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: ['chrome90', 'firefox113', 'safari16.4'],
  legalComments: 'none', // the licenses stand in the page in full
}).outputFiles[0].text;
const style = buildSync({
  entryPoints: [join(source, 'style.css')], minify: true, write: false,
}).outputFiles[0].text;
const { version } = JSON.parse(readFileSync(join(modules, 'three', 'package.json'), 'utf8'));
const license = `three.js ${version}\n\n${readFileSync(join(modules, 'three', 'LICENSE'), 'utf8')}`;
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

// Functions as replacements: a '$' in a text means nothing then.
const page = read('page.html')
  .replace('/*style*/', () => style)
  .replace('<!--license-->', () => escaped(license))
  .replace('/*script*/', () => script);
writeFileSync(htmlPath, page);

const bytes = Buffer.from(page, 'utf8');
const lines = [];
for (let start = 0; start < bytes.length; start += 4096) {
  let line = '';
  for (const byte of bytes.subarray(start, start + 4096)) {
    const plain = byte >= 0x20 && byte < 0x7f && !'"\\?'.includes(String.fromCharCode(byte));
    // Octal escapes end after three digits, whatever follows.
    line += plain ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, '0')}`;
  }
  lines.push(`    "${line}"`);
}
writeFileSync(cppPath, `// Made by apps/viewer/build.mjs.
#include "viewer_page.h"

namespace trivalent::apps {

const std::string_view viewer_page(
${lines.join('\n')},
    ${bytes.length});

}  // namespace trivalent::apps
`);
