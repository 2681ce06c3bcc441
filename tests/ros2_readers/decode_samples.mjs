// Decodes serialized messages with the libraries of Foxglove, encodes them again and compares.
// usage: node decode_samples.mjs NODE_MODULES FOLDER TOPIC=TYPE,... DEFINITIONS.mcap...
// FOLDER has files TOPIC.N.cdr, with '_' for '/'; the definitions are of the types of the files.
// Prints one line of JSON a topic: its type, the number of messages and the last one.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const [modules, folder, list, ...recordings] = process.argv.slice(2);
const load = createRequire(join(modules, 'x.js'));
const { McapStreamReader } = load('@mcap/core');
const { parse } = load('@foxglove/rosmsg');
const { MessageReader, MessageWriter } = load('@foxglove/rosmsg2-serialization');
const { decompress } = load('fzstd');

const definitions = {};
for (const name of recordings) {
  const reader = new McapStreamReader({ decompressHandlers: { zstd: (bytes) => decompress(bytes) } });
  reader.append(readFileSync(name));
  for (let record; (record = reader.nextRecord());) {
    if (record.type !== 'Schema') continue;
    definitions[record.name] = parse(new TextDecoder().decode(record.data), { ros2: true });
  }
}

const files = readdirSync(folder);
for (const item of list.split(',')) {
  const [topic, type] = item.split('=');
  const definition = definitions[type.replace('/', '/msg/')];
  assert.ok(definition, `no definition of ${type}`);
  const reader = new MessageReader(definition);
  const writer = new MessageWriter(definition);
  const start = topic.replaceAll('/', '_') + '.';
  const names = files.filter((name) => name.startsWith(start) && name.endsWith('.cdr'));
  assert.ok(names.length > 0, `no message of ${topic}`);
  let last;
  names.sort((a, b) => Number(a.split('.')[1]) - Number(b.split('.')[1]));
  for (const name of names) {
    const bytes = readFileSync(join(folder, name));
    last = reader.readMessage(bytes);
    const again = Buffer.from(writer.writeMessage(last));
    assert.ok(bytes.length - again.length >= 0 && bytes.length - again.length < 4, name);
    assert.ok(again.equals(bytes.subarray(0, again.length)), `${name} differs`);
  }
  const plain = (key, value) => ArrayBuffer.isView(value) ? { length: value.length } : value;
  console.log(JSON.stringify({ topic, type, count: names.length, last }, plain));
}
