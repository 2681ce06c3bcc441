"""A private ROS master, the nodes of MMS-SLAM, and a bag player, for the tests."""
import importlib
import importlib.util
import os
import shutil
import socket
import subprocess
import sys
import threading
import time

SKIPPED = 77  # exit code

NODE = '/mms_slam'
REMAPPINGS = ['color/image_raw:=/camera/color/image_raw',
              'color/camera_info:=/camera/color/camera_info',
              'depth/image_raw:=/camera/aligned_depth_to_color/image_raw']
COLOR, DEPTH, POINTS = ('/camera/color/image_raw', '/camera/aligned_depth_to_color/image_raw',
                        '/points')


def skip_without_ros():
    """Skips the test with a message where ROS is not installed."""
    missing = [name for name in ('rosmaster',) if shutil.which(name) is None]
    for name in ('rospy', 'rosbag', 'sensor_msgs', 'nav_msgs', 'tf2_msgs', 'visualization_msgs',
                 'diagnostic_msgs', 'std_srvs'):
        if importlib.util.find_spec(name) is None:
            missing.append('python3-' + name.replace('_', '-'))
    if missing:
        print('skipped: ROS 1 is not installed completely, missing: ' + ', '.join(missing))
        sys.exit(SKIPPED)


def import_mms_msgs(source, folder):
    """Generates the Python classes of mms_msgs, as catkin does, and imports them."""
    generator = '/usr/lib/genpy/genmsg_py.py'
    package = os.path.join(source, 'interfaces/ros1/mms_msgs/msg')
    output = os.path.join(folder, 'mms_msgs', 'msg')
    os.makedirs(output)
    paths = ['-Imms_msgs:' + package]
    for name in ('std_msgs', 'geometry_msgs'):
        paths.append('-I%s:/usr/share/%s/msg' % (name, name))
    names = sorted(os.listdir(package))
    subprocess.check_call(['/usr/bin/python3', generator, '-p', 'mms_msgs', '-o', output] + paths +
                          [os.path.join(package, name) for name in names])
    with open(os.path.join(output, '__init__.py'), 'w') as init:
        for name in names:
            init.write('from ._%s import *\n' % name[:-4])
    open(os.path.join(folder, 'mms_msgs', '__init__.py'), 'w').close()
    sys.path.insert(0, folder)
    return importlib.import_module('mms_msgs.msg')


def free_port():
    with socket.socket() as probe:
        probe.bind(('', 0))
        return probe.getsockname()[1]


class Session:
    """Processes that end with the session; `prefix` precedes commands, e.g. "ip netns exec NAME"."""

    def __init__(self, folder, host='localhost', port=None):
        self.folder = folder
        self.processes = []
        os.environ['ROS_MASTER_URI'] = 'http://%s:%d' % (host, port or free_port())
        os.environ['ROS_HOSTNAME'] = host
        os.environ['ROS_LOG_DIR'] = os.path.join(folder, 'log')
        os.environ.pop('ROS_IP', None)

    def start(self, name, command, prefix=(), **environment):
        log = open(os.path.join(self.folder, name + '.txt'), 'w')
        process = subprocess.Popen(list(prefix) + command, stdout=log, stderr=subprocess.STDOUT,
                                   env=dict(os.environ, **environment))
        self.processes.append(process)
        return process

    def start_master(self):
        port = os.environ['ROS_MASTER_URI'].rsplit(':', 1)[1]
        self.start('master', ['rosmaster', '--core', '-p', port])
        import rosgraph
        self.wait('the master', lambda: rosgraph.is_master_online())

    def log(self, name):
        with open(os.path.join(self.folder, name + '.txt')) as log:
            return log.read()

    def wait(self, what, condition, seconds=30.0):
        end = time.time() + seconds
        while time.time() < end:
            if condition():
                return
            time.sleep(0.02)
        logs = ''.join('--- %s\n%s' % (f, open(os.path.join(self.folder, f)).read()[-2000:])
                       for f in os.listdir(self.folder) if f.endswith('.txt'))
        raise AssertionError('waited %g s for %s\n%s' % (seconds, what, logs))

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Recorder:
    """Records the messages of topics; `latest` of a topic is None before the first one."""

    def __init__(self):
        self.messages = {}
        self.subscribers = {}
        self.lock = threading.Lock()

    def subscribe(self, topic, message_class):
        import rospy
        self.messages[topic] = []
        self.subscribers[topic] = rospy.Subscriber(topic, message_class, self.keep, topic,
                                                   queue_size=1000)

    def connected(self):
        return all(s.get_num_connections() > 0 for s in self.subscribers.values())

    def keep(self, message, topic):
        with self.lock:
            self.messages[topic].append(message)

    def count(self, topic):
        return len(self.messages[topic])

    def latest(self, topic):
        return self.messages[topic][-1] if self.messages[topic] else None


class Player:
    """Plays the sensor's topics of a bag: those of a depth camera, or of a LiDAR with a camera."""

    def __init__(self, bag, lidar=False):
        import rospy
        from sensor_msgs.msg import CameraInfo, Image, PointCloud2
        from tf2_msgs.msg import TFMessage
        self.bag = bag
        self.frame_topic = POINTS if lidar else COLOR
        classes = {COLOR: Image, '/camera/color/camera_info': CameraInfo}
        classes.update({POINTS: PointCloud2, '/tf_static': TFMessage} if lidar else {DEPTH: Image})
        self.publishers = {topic: rospy.Publisher(topic, message_class, queue_size=100)
                           for topic, message_class in classes.items()}

    def connected(self, node=NODE):
        """Whether `node` has subscribed to every topic; other subscribers are ignored."""
        return all(node in (connection[1] for connection in publisher.impl.get_stats_info())
                   for publisher in self.publishers.values())

    def play(self, before_frame, count=10**9):
        """Publishes all messages; calls before_frame(index, stamp) before the first message of each frame.
        Transforms follow after the first frame, as with nodes that start in any order."""
        import rosbag
        frames = 0
        transforms = []
        with rosbag.Bag(self.bag) as bag:
            for topic, message, _ in bag.read_messages(topics=list(self.publishers)):
                if topic == self.frame_topic:
                    if frames == count:
                        return frames
                    before_frame(frames, message.header.stamp)
                    frames += 1
                if topic == '/tf_static' and frames == 0:
                    transforms.append(message)
                    continue
                if frames == 2 and topic == self.frame_topic:
                    for held_back in transforms:
                        self.publishers['/tf_static'].publish(held_back)
                self.publishers[topic].publish(message)
        return frames


def position(odometry):
    p = odometry.pose.pose.position
    return (p.x, p.y, p.z)


def read_tum(path):
    """Positions by stamp in nanoseconds."""
    poses = {}
    for line in open(path):
        if line.startswith('#') or not line.strip():
            continue
        fields = line.split()
        seconds, _, fraction = fields[0].partition('.')
        stamp = int(seconds) * 10**9 + int((fraction + '0' * 9)[:9])
        poses[stamp] = tuple(float(f) for f in fields[1:4])
    return poses


def distance(a, b):
    return sum((x - y)**2 for x, y in zip(a, b))**0.5
