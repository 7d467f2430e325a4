// An independent canonical form: JavaScript's own numbers and texts, members sorted. Usage: node canonical.mjs PROGRAM
import { execFileSync } from 'node:child_process';

const canonical = (value) => {
  if (Array.isArray(value)) return '[' + value.map(canonical).join(',') + ']';
  if (value !== null && typeof value === 'object') {
    return '{' + Object.keys(value).sort().map((k) => JSON.stringify(k) + ':' + canonical(value[k])).join(',') + '}';
  }
  return JSON.stringify(value);
};

// Park and Miller's generator: the same cases on every machine.
let seed = 43;
const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
const text = () => Array.from({ length: Math.floor(random() * 8) }, () =>
  String.fromCodePoint([9, 34, 92, 31, 65, 0xe9, 0x20ac, 0x1f600, 0xfb33][Math.floor(random() * 9)])).join('');
const number = () => {
  const bits = new DataView(new ArrayBuffer(8));
  bits.setUint32(0, Math.floor(random() * 2 ** 32));
  bits.setUint32(4, Math.floor(random() * 2 ** 32));
  const any = bits.getFloat64(0);
  return random() < 0.5 && Number.isFinite(any) ? any : Math.round(random() * 1e6) / 10 ** Math.floor(random() * 12);
};
const value = (depth) => {
  const kind = random();
  if (depth < 4 && kind < 0.25) return Array.from({ length: Math.floor(random() * 5) }, () => value(depth + 1));
  if (depth < 4 && kind < 0.5) {
    return Object.fromEntries(Array.from({ length: Math.floor(random() * 5) }, () => [text(), value(depth + 1)]));
  }
  return [null, true, false, text(), number(), number(), number()][Math.floor(random() * 7)];
};

const values = Array.from({ length: 3000 }, () => value(0));
const found = execFileSync(process.argv[2], { input: values.map((v) => JSON.stringify(v)).join('\n') + '\n',
  maxBuffer: 1 << 28 }).toString().split('\n');
let wrong = 0;
values.forEach((v, k) => {
  if (found[k] !== canonical(v)) {
    wrong += 1;
    console.log(`case ${k}: found ${found[k]}, expected ${canonical(v)}`);
  }
});
console.log(`${values.length} cases, ${wrong} differ`);
process.exit(wrong === 0 ? 0 : 1);
