#!/usr/bin/python3
"""Segmentation on another host: plays a simulated recording in real time to the SLAM node in one
network namespace, with the segmentation node in another, and prints the effect of a delayed, lossy
and interrupted link. Needs root for the namespaces.

usage: [SCENE=crowd] remote_masks.py BUILD_FOLDER [FRAMES] [tcp|udp|bbr ...]"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

from ros_session import NODE, REMAPPINGS, Player, Recorder, Session, skip_without_ros

HERE = os.path.dirname(os.path.abspath(__file__))
ROBOT, SERVER = 'mms_robot', 'mms_server'
ROBOT_IP, SERVER_IP = '10.77.0.1', '10.77.0.2'
SCENE = os.environ.get('SCENE', 'warehouse_loop')
DELAY_MS, LOSS = 100, 5
LIMIT = 1.25


def sh(*command):
    subprocess.check_call(command, stdout=subprocess.DEVNULL)


def in_namespace(name):
    return ['ip', 'netns', 'exec', name]


class Link:
    """Two namespaces joined by veth with netem, or by lossy_link.py on kernels without netem."""

    def __init__(self, folder):
        self.control = os.path.join(folder, 'link')
        self.process = None
        self.remove()
        for name in (ROBOT, SERVER):
            sh('ip', 'netns', 'add', name)
        self.netem = self.try_netem()
        if not self.netem:
            self.set(0, 0)
            self.process = subprocess.Popen(
                [sys.executable, os.path.join(HERE, 'lossy_link.py'), ROBOT, ROBOT_IP, SERVER,
                 SERVER_IP, self.control], stdout=subprocess.PIPE)
            self.process.stdout.readline()

    def try_netem(self):
        sh('ip', '-n', ROBOT, 'link', 'add', 'name', 'wire', 'type', 'veth', 'peer', 'name', 'wire',
           'netns', SERVER)
        for name, address in ((ROBOT, ROBOT_IP), (SERVER, SERVER_IP)):
            sh('ip', '-n', name, 'addr', 'add', address + '/24', 'dev', 'wire')
            for device in ('lo', 'wire'):
                sh('ip', '-n', name, 'link', 'set', device, 'up')
            netem = in_namespace(name) + ['tc', 'qdisc', 'add', 'dev', 'wire', 'root', 'netem']
            if subprocess.call(netem, stderr=subprocess.DEVNULL) != 0:
                sh('ip', '-n', ROBOT, 'link', 'del', 'wire')
                return False
        return True

    def set(self, delay_ms, loss):
        if self.process is None and getattr(self, 'netem', False):
            for name in (ROBOT, SERVER):
                sh(*in_namespace(name), 'tc', 'qdisc', 'change', 'dev', 'wire', 'root', 'netem',
                   'delay', '%dms' % delay_ms, 'loss', '%d%%' % loss)
            return
        with open(self.control + '.new', 'w') as control:
            control.write('%g %g' % (delay_ms, loss))
        os.rename(self.control + '.new', self.control)

    def remove(self):
        if self.process:
            self.process.kill()
        for name in (ROBOT, SERVER):
            subprocess.call(['ip', 'netns', 'del', name], stderr=subprocess.DEVNULL)


def diagnosis(recorder):
    message = recorder.latest('/diagnostics')
    return {v.key: v.value for v in message.status[0].values} if message else {}


def play_inside(bag, output, link_control, cut):
    """Plays the bag in the robot's namespace, and writes poses and counts."""
    import rospy
    from diagnostic_msgs.msg import DiagnosticArray
    from nav_msgs.msg import Odometry
    rospy.init_node('player', disable_signals=True)
    recorder = Recorder()
    recorder.subscribe('/diagnostics', DiagnosticArray)
    recorder.subscribe(NODE + '/odometry', Odometry)
    player = Player(bag)
    while not player.connected():
        time.sleep(0.05)
    time.sleep(2.0)  # the segmentation node finds the images' topic
    total = int(os.environ['FRAMES'])
    start = time.time()

    def keep_pace(index, stamp):
        time.sleep(max(0.0, start + stamp.to_sec() - time.time()))
        for part, loss in ((0.4, '100'), (0.7, '0')):
            if cut and index == int(part * total):
                with open(link_control + '.new', 'w') as control:
                    control.write('%d %s' % (DELAY_MS, loss))
                os.rename(link_control + '.new', link_control)
    frames = player.play(keep_pace)
    played = time.time() - start
    while diagnosis(recorder).get('frames') != str(recorder.count(NODE + '/odometry')) or \
            diagnosis(recorder).get('frames/s') != '0':
        time.sleep(0.2)
    with open(output + '.tum', 'w') as poses:
        for m in recorder.messages[NODE + '/odometry']:
            p, q = m.pose.pose.position, m.pose.pose.orientation
            poses.write('%d.%09d %r %r %r %r %r %r %r\n' %
                        (m.header.stamp.secs, m.header.stamp.nsecs, p.x, p.y, p.z, q.x, q.y, q.z, q.w))
    counts = diagnosis(recorder)
    counts.update(played=frames, seconds=played,
                  lost_link=sum(m.status[0].level == 2 for m in recorder.messages['/diagnostics']))
    with open(output + '.json', 'w') as out:
        json.dump(counts, out)


def run_once(build, folder, bag, frames, name, transport, delay_ms, loss, cut=False):
    link = Link(folder)
    try:
        if transport == 'bbr':
            for namespace in (ROBOT, SERVER):
                sh(*in_namespace(namespace), 'sysctl', '-w', 'net.ipv4.tcp_congestion_control=bbr')
        protocol = 'udp' if transport == 'udp' else 'tcp'
        output = os.path.join(folder, name)
        os.makedirs(output + '_log')
        with Session(output + '_log', ROBOT_IP, 11399) as session:
            robot, server = in_namespace(ROBOT), in_namespace(SERVER)
            session.start('master', ['rosmaster', '--core', '-p', '11399'], robot)
            time.sleep(2)
            session.start('slam', [os.path.join(build, 'mms_slam_node'), '_masks:=remote',
                                   '_mask_transport:=' + protocol] +
                          REMAPPINGS + os.environ.get('SLAM', '').split(), robot)
            session.start('segmentation', [os.path.join(build, 'mms_segmentation_node'),
                                           '_mask_transport:=' + protocol,
                                           '~image:=%s/segmentation/image' % NODE,
                                           '~masks:=%s/segmentation/masks' % NODE], server,
                          ROS_HOSTNAME=SERVER_IP)
            time.sleep(4)  # nodes connect on a link without faults, as in a docking station
            link.set(delay_ms, loss)
            play = session.start('player', [sys.executable, __file__, '--inside', bag, output,
                                            link.control, str(int(cut))], robot,
                                 FRAMES=str(frames))
            if play.wait(600) != 0:
                raise RuntimeError(session.log('player') + session.log('slam'))
            log = session.log('slam')
    finally:
        link.remove()
    counts = json.load(open(output + '.json'))
    counts['log'] = [line for line in log.splitlines() if 'link' in line or 'again' in line]
    return counts


def ate_cm(build, folder, name):
    out = subprocess.check_output([os.path.join(build, 'mms'), 'eval', 'trajectory',
                                   os.path.join(folder, 'truth/groundtruth.txt'),
                                   os.path.join(folder, name + '.tum'), '--json'])
    return 100 * json.loads(out)['ate_rmse_m']


def row(name, counts, ate, reference):
    number = lambda key: int(float(counts.get(key, 0)))
    rate = number('frames') / (counts['played'] / counts['rate'])
    print('| %s | %d of %d | %.1f | %d | %d | %d | %.0f | %.2f | %.2f |' %
          (name, number('frames'), counts['played'], rate, number('masks used'),
           number('masks late'), number('masks missing'),
           float(counts.get('mask delay [ms]', 0)), ate, ate / reference), flush=True)


def main():
    build = os.path.abspath(sys.argv[1])
    frames = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    transports = sys.argv[3:] or ['tcp', 'bbr', 'udp']
    skip_without_ros()
    folder = tempfile.mkdtemp()
    try:
        mms = os.path.join(build, 'mms')
        quiet = dict(cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        subprocess.check_call([mms, 'simulate', SCENE, '-o', 'truth', '--frames', str(frames)], **quiet)
        subprocess.check_call([mms, 'convert', 'truth', '-o', 'x.bag'], **quiet)
        bag = os.path.join(folder, 'x.bag')
        print('| link | frames | a second | masks used | late | missing | delay [ms] | ATE [cm] | ratio |')
        print('| --- | --- | --- | --- | --- | --- | --- | --- | --- |', flush=True)
        reference = None
        runs = [('no fault, ' + transports[0], transports[0], 0, 0, False)]
        runs += [('%d ms, %d %% lost, %s' % (DELAY_MS, LOSS, t), t, DELAY_MS, LOSS, False)
                 for t in transports]
        runs += [('cut from 40 to 70 %%, %s' % transports[-1], transports[-1], DELAY_MS, 0, True)]
        logs = []
        worst = 0.0
        for i, (name, transport, delay_ms, loss, cut) in enumerate(runs):
            counts = run_once(build, folder, bag, frames, 'run%d' % i, transport, delay_ms, loss, cut)
            counts['rate'] = counts['played'] / counts['seconds']
            ate = ate_cm(build, folder, 'run%d' % i)
            reference = reference or ate
            row(name, counts, ate, reference)
            logs = counts['log']
        print('\nlog of the SLAM node on the interrupted link:')
        for line in logs:
            print(line)
    finally:
        shutil.rmtree(folder)


if len(sys.argv) > 1 and sys.argv[1] == '--inside':
    play_inside(sys.argv[2], sys.argv[3], sys.argv[4], sys.argv[5] == '1')
else:
    main()
