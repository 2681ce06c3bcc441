// Checks the MCAP files of `mms convert` with the readers of Foxglove, and opens a file of their
// writer with mms.
// usage: node readers_test.mjs MMS NODE_MODULES (readers_test.sh installs the packages)
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [mms, modules] = process.argv.slice(2);
const load = createRequire(join(modules, 'x.js'));
const { McapIndexedReader, McapStreamReader, McapWriter } = load('@mcap/core');
const { parse } = load('@foxglove/rosmsg');
const { MessageReader, MessageWriter } = load('@foxglove/rosmsg2-serialization');
const { decompress } = load('fzstd');

const decompressHandlers = { zstd: (bytes) => decompress(bytes) };
const folder = mkdtempSync(join(tmpdir(), 'mms_readers_'));
const run = (...words) => execFileSync(mms, words, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });

class Memory {
  constructor(bytes) { this.bytes = bytes; }
  async size() { return BigInt(this.bytes.length); }
  async read(offset, size) {
    return new Uint8Array(this.bytes.subarray(Number(offset), Number(offset + size)));
  }
}

class Buffers {
  parts = [];
  size = 0;
  position() { return BigInt(this.size); }
  async write(bytes) { this.parts.push(Buffer.from(bytes)); this.size += bytes.length; }
}

const definitionOf = (schema) => parse(new TextDecoder().decode(schema.data), { ros2: true });

/// The decoded messages of a file by topic, found by its indexes.
async function readIndexed(name) {
  const reader = await McapIndexedReader.Initialize({
    readable: new Memory(readFileSync(join(folder, name))), decompressHandlers });
  assert.equal(reader.header.profile, 'ros2');
  const topics = {};
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(channel.messageEncoding, 'cdr');
    assert.equal(schema.encoding, 'ros2msg');
    const topic = topics[channel.topic] ??= { schema, messages: [],
                                              reader: new MessageReader(definitionOf(schema)) };
    topic.messages.push({ time: message.logTime, value: topic.reader.readMessage(message.data) });
  }
  const count = Object.values(topics).reduce((sum, topic) => sum + topic.messages.length, 0);
  assert.equal(reader.statistics.messageCount, BigInt(count));
  return topics;
}

/// Reads all records in their order, with checksums. Returns the number of messages.
function countStreamed(name) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  reader.append(readFileSync(join(folder, name)));
  let count = 0;
  for (let record; (record = reader.nextRecord());) count += record.type === 'Message';
  assert.ok(reader.done());
  return count;
}

/// Writes the messages again, without compression, encoded by the other library.
async function rewrite(topics, name) {
  const buffers = new Buffers();
  const writer = new McapWriter({ writable: buffers, chunkSize: 50_000 });
  await writer.start({ profile: 'ros2', library: 'test' });
  const messages = [];
  for (const [topic, { schema, messages: list }] of Object.entries(topics)) {
    const schemaId = await writer.registerSchema(schema);
    const channelId = await writer.registerChannel({
      topic, schemaId, messageEncoding: 'cdr', metadata: new Map() });
    const encoder = new MessageWriter(definitionOf(schema));
    for (const { time, value } of list) messages.push({ channelId, time, value, encoder });
  }
  messages.sort((a, b) => (a.time < b.time ? -1 : 1));
  for (const { channelId, time, value, encoder } of messages) {
    await writer.addMessage({ channelId, sequence: 0, logTime: time, publishTime: time,
                              data: encoder.writeMessage(value) });
  }
  await writer.end();
  writeFileSync(join(folder, name), Buffer.concat(buffers.parts));
}

function trajectory(recording) {
  run('run', recording, '--segmenter', 'masks', '-o', 'result', '--overwrite');
  return readFileSync(join(folder, 'result/trajectory.tum'), 'utf8');
}

async function check(scene, name, types) {
  run('convert', scene, '-o', name);
  const topics = await readIndexed(name);
  const found = Object.fromEntries(
    Object.entries(topics).map(([topic, { schema }]) => [topic, schema.name]));
  assert.deepEqual(found, types);
  const count = Object.values(topics).reduce((sum, topic) => sum + topic.messages.length, 0);
  assert.equal(countStreamed(name), count);
  await rewrite(topics, 'theirs_' + name);
  assert.equal(trajectory('theirs_' + name), trajectory(name));
  console.log(`ok: ${name}, ${count} messages of ${Object.keys(types).join(', ')}`);
  return topics;
}

try {
  const scene = 'sim:warehouse_loop?frames=5&width=160';
  const camera = await check(scene, 'camera.mcap', {
    '/camera/color/camera_info': 'sensor_msgs/msg/CameraInfo',
    '/camera/color/image_raw': 'sensor_msgs/msg/Image',
    '/camera/aligned_depth_to_color/image_raw': 'sensor_msgs/msg/Image',
    '/camera/mask/image_raw': 'sensor_msgs/msg/Image',
    '/ground_truth': 'geometry_msgs/msg/PoseStamped',
  });
  const image = camera['/camera/color/image_raw'].messages[3].value;
  assert.equal(image.width, 160);
  assert.equal(image.encoding, 'rgb8');
  assert.equal(image.data.length, image.height * image.step);
  assert.equal(image.header.frame_id, 'camera_color_optical_frame');
  const info = camera['/camera/color/camera_info'].messages[0].value;
  assert.equal(info.width, 160);
  assert.equal(info.k[8], 1);
  assert.equal(info.p[0], info.k[0]);

  run('convert', scene, '-o', 'folder');
  const truth = readFileSync(join(folder, 'folder/groundtruth.txt'), 'utf8')
    .split('\n').filter((line) => line && !line.startsWith('#')).map((line) => line.split(/\s+/));
  const poses = camera['/ground_truth'].messages;
  assert.equal(poses.length, truth.length);
  truth.forEach((line, i) => {
    const { header, pose } = poses[i].value;
    const nanoseconds = String(header.stamp.nanosec ?? header.stamp.nsec).padStart(9, '0');
    assert.equal(`${header.stamp.sec}.${nanoseconds}`, line[0]);
    assert.ok(Math.abs(pose.position.x - Number(line[1])) < 1e-6);
    assert.ok(Math.abs(pose.orientation.w - Number(line[7])) < 1e-6);
  });

  const lidar = await check(scene + '&sensor=lidar16', 'lidar.mcap', {
    '/camera/color/camera_info': 'sensor_msgs/msg/CameraInfo',
    '/camera/color/image_raw': 'sensor_msgs/msg/Image',
    '/camera/mask/image_raw': 'sensor_msgs/msg/Image',
    '/points': 'sensor_msgs/msg/PointCloud2',
    '/tf_static': 'tf2_msgs/msg/TFMessage',
    '/ground_truth': 'geometry_msgs/msg/PoseStamped',
  });
  const cloud = lidar['/points'].messages[2].value;
  assert.deepEqual(cloud.fields.map((field) => field.name),
                   ['x', 'y', 'z', 'intensity', 'time']);
  assert.equal(cloud.data.length, cloud.width * cloud.point_step);
  assert.equal(lidar['/tf_static'].messages[0].value.transforms[0].child_frame_id, 'lidar');

  run('run', 'sim:warehouse_loop?frames=8', '--segmenter', 'masks', '--mcap', '-o', 'run');
  const results = await readIndexed('run/run.mcap');
  assert.deepEqual(Object.fromEntries(
    Object.entries(results).map(([topic, { schema }]) => [topic, schema.name])), {
    '/tf': 'tf2_msgs/msg/TFMessage',
    '/odometry': 'nav_msgs/msg/Odometry',
    '/path': 'nav_msgs/msg/Path',
    '/overlay/compressed': 'sensor_msgs/msg/CompressedImage',
    '/overlay/camera_info': 'sensor_msgs/msg/CameraInfo',
    '/static_cloud': 'sensor_msgs/msg/PointCloud2',
    '/dynamic_cloud': 'sensor_msgs/msg/PointCloud2',
    '/map': 'sensor_msgs/msg/PointCloud2',
    '/object_markers': 'visualization_msgs/msg/MarkerArray',
    '/objects': 'mms_msgs/msg/Objects',
    '/diagnostics': 'diagnostic_msgs/msg/DiagnosticArray',
  });
  const lines = readFileSync(join(folder, 'run/trajectory.tum'), 'utf8').trim().split('\n')
    .filter((line) => !line.startsWith('#')).map((line) => line.split(/\s+/).map(Number));
  assert.equal(results['/odometry'].messages.length, lines.length);
  for (const { value } of results['/tf'].messages) {
    assert.deepEqual(value.transforms.map((t) => [t.header.frame_id, t.child_frame_id]),
                     [['world', 'camera'], ['map', 'world']]);
  }
  const path = results['/path'].messages.at(-1).value.poses;
  lines.forEach((line, i) => {
    const { position, orientation } = results['/odometry'].messages[i].value.pose.pose;
    assert.ok(Math.abs(position.z - line[3]) < 1e-6);
    assert.ok(Math.abs(orientation.w - line[7]) < 1e-6);
    assert.ok(Math.abs(path[i].pose.position.x - line[1]) < 1e-6);
  });
  const ply = readFileSync(join(folder, 'run/static_map.ply'), 'latin1');
  assert.equal(results['/map'].messages.at(-1).value.width,
               Number(ply.match(/element vertex (\d+)/)[1]));
  const markers = results['/object_markers'].messages.at(-1).value.markers;
  assert.equal(markers[0].action, 3);  // DELETEALL
  assert.equal(markers.length, 1 + 2 * results['/objects'].messages.at(-1).value.objects.length);
  assert.match(results['/overlay/compressed'].messages[0].value.format, /jpeg/);
  assert.equal(results['/diagnostics'].messages.at(-1).value.status[0].message, 'tracking');
  console.log('ok: run.mcap');
} finally {
  rmSync(folder, { recursive: true });
}
