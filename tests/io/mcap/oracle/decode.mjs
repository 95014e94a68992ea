// Decodes an MCAP file with @mcap/core: number of messages, and of each number in them count, ends and sum, as JSON.
import {readFileSync} from 'node:fs';
import {McapStreamReader} from '@mcap/core';
import {parse} from '@foxglove/rosmsg';
import {MessageReader} from '@foxglove/rosmsg2-serialization';
import {decompress} from 'fzstd';
const file = process.argv[2];
const reader = new McapStreamReader({decompressHandlers: {zstd: (b) => decompress(b)}});
reader.append(readFileSync(file));
const schemas = new Map(), channels = new Map(), out = {};
const add = (fields, name, v) => {
  if (typeof v === 'boolean') v = v ? 1 : 0;
  if (typeof v === 'bigint') v = Number(v);
  if (typeof v === 'number') {
    const f = (fields[name] ??= {n: 0, first: v, last: v, sum: 0});
    ++f.n; f.last = v; if (Number.isFinite(v)) f.sum += v;
  } else if (v && typeof v === 'object') {
    if (Array.isArray(v) || ArrayBuffer.isView(v)) { let i = 0; for (const e of v) add(fields, `${name}[${i++}]`, e); }
    else for (const [k, e] of Object.entries(v)) add(fields, name ? `${name}.${k}` : k, e);
  }
};
for (let r; (r = reader.nextRecord());) {
  if (r.type === 'Schema') schemas.set(r.id, r);
  if (r.type === 'Channel') {
    const s = schemas.get(r.schemaId);
    channels.set(r.id, {topic: r.topic, reader: new MessageReader(parse(new TextDecoder().decode(s.data), {ros2: true}))});
  }
  if (r.type === 'Message') {
    const c = channels.get(r.channelId);
    const t = (out[c.topic] ??= {samples: 0, fields: {}});
    ++t.samples;
    add(t.fields, '', c.reader.readMessage(r.data));
  }
}
console.log(JSON.stringify(out, null, 1));
