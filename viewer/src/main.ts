import { Connection } from './protocol/connection';
import type { Vector3 } from './protocol/messages';
import { SceneView } from './scene/scene_view';
import { Place } from './state/place';
import { Run } from './state/run';
import { Settings } from './state/settings';
import { ChartPanel } from './ui/chart_panel';
import { part } from './ui/dom';
import { Downloads, save } from './ui/downloads';
import { buildHelp } from './ui/help';
import { icon } from './ui/icons';
import { ImagePanel } from './ui/image_panel';
import { LayerPanel } from './ui/layer_panel';
import { Notice } from './ui/notice';
import { ObjectPanel } from './ui/object_panel';
import { Player } from './ui/player';
import { Readout } from './ui/readout';
import { listenToKeys } from './ui/shortcuts';
import { Tabs } from './ui/tabs';
import { ViewModes } from './ui/view_modes';

/** Largest number of map points on this device: phones have less memory. */
const kMapPoints = matchMedia('(pointer: coarse)').matches ? 1_500_000 : 5_000_000;
const kFocusEvery = 600;
/** The server closes silent connections, and its answer shows that it is there [ms]. */
const kFocusAtLeastEvery = 5000;
let focus: Vector3 = [0, 0, 0];
let focusSent = 0;

const run = new Run();
const settings = new Settings(localStorageOrNull());
const notice = new Notice(run, () => connection.hurry());
const connection = new Connection(socketAddress(), {
  message: (message) => run.apply(message),
  state: (state) => {
    notice.connection(state);
    if (state.kind === 'open') sendWanted();
  },
  fault: (error) => {
    console.error(error);
    notice.toast(error.message);
  },
});

if (!hasWebGl()) {
  notice.stop('This browser has no WebGL 2', 'Turn on graphics acceleration in its settings, or use another browser.');
  throw new Error('WebGL 2 is missing');
}
const scene = new SceneView(part('scene'), run, settings);
const player = new Player(run, (command) => connection.send(command));
new Place(run, (command) => connection.send(command));
new ImagePanel(run, settings);
new ChartPanel(run, (frame) => player.seek(frame));
new ObjectPanel(run);
new Readout(run);
new LayerPanel(run, settings);
new Downloads(run);
new ViewModes(settings, () => scene.resetView());
new Tabs(() => sendWanted());
buildHelp();
listenToKeys({ player, settings, picture: () => void takePicture(), resetView: () => scene.resetView() });

const screenshot = part('screenshot');
screenshot.append(icon('camera'));
screenshot.addEventListener('click', () => void takePicture());
const help = part('help-button');
help.append(icon('help'));
help.addEventListener('click', () => part<HTMLDialogElement>('help').showModal());

run.on('hello', ({ hello }) => {
  document.title = `${hello.name} · MMS-SLAM`;
  part('run-name').textContent = hello.name;
  part('run-data').textContent = hello.data === hello.name ? '' : hello.data;
  showBadge();
});
run.on('playback', showBadge);
settings.on('layer', (layer) => layer === 'scan' && sendWanted());
addEventListener('online', () => connection.hurry());
addEventListener('resize', () => sendWanted());

connection.connect();
setInterval(sendFocus, kFocusEvery);

function hasWebGl(): boolean {
  return document.createElement('canvas').getContext('webgl2') !== null;
}

function showBadge(): void {
  const badge = part('badge');
  badge.hidden = run.hello === null;
  badge.textContent = run.live ? 'Live' : run.hello?.live ? 'Run ended' : 'Finished run';
  badge.classList.toggle('live', run.live);
}

/** Saves server time and bandwidth for hidden layers. */
function sendWanted(): void {
  const image = part('panel-image').offsetParent !== null;
  connection.send({ type: 'want', points: settings.shows('scan'), image, map: true, budget: kMapPoints });
}

/** The map is refined first near the user's focus. */
function sendFocus(): void {
  const point = scene.focus;
  connection.check();
  const rests = Math.hypot(...point.map((value, i) => value - focus[i])) < 1;
  if (rests && Date.now() - focusSent < kFocusAtLeastEvery) return;
  if (!connection.send({ type: 'focus', point })) return;
  focus = point;
  focusSent = Date.now();
}

async function takePicture(): Promise<void> {
  const picture = await scene.picture();
  if (picture) save(picture, `${run.hello?.name ?? 'mms'}_${run.frame?.frame ?? 0}.png`);
}

function socketAddress(): string {
  const address = new URL('./ws', location.href);
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
  return address.href;
}

function localStorageOrNull(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null; // forbidden by the browser's settings
  }
}
