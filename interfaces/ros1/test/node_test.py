#!/usr/bin/python3
"""Plays a bag to mms_slam_node under a ROS master and compares its messages with `mms run` on the
same bag. usage: node_test.py BUILD_FOLDER SOURCE_FOLDER"""
import os
import subprocess
import sys
import tempfile

from ros_session import (NODE, REMAPPINGS, SKIPPED, Player, Recorder, Session, distance,
                         import_mms_msgs, position, read_tum, skip_without_ros)

FRAMES = 60
SCENE = 'sim:warehouse_loop?width=320&frames=%d' % FRAMES
LIDAR_SCENE = 'sim:warehouse_loop?width=320&frames=15&sensor=lidar16'
LIDAR_NODE = '/mms_lidar'
AHEAD = 2  # frames in flight: the node drops none, and waits for each image


def check(condition, what):
    if not condition:
        raise AssertionError(what)
    print('ok: ' + what)


def diagnosis(recorder):
    for message in reversed(recorder.messages['/diagnostics']):
        for status in message.status:
            if status.name.startswith(NODE):
                return status
    return None


def make_reference(mms, folder, scene, name):
    """Makes the bag `name`.bag. Returns the positions of `mms run` on it."""
    def run(*words):
        subprocess.check_call([mms] + list(words), cwd=folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    run('convert', scene, '-o', name + '.bag')
    run('run', name + '.bag', '-o', name)
    return read_tum(os.path.join(folder, name, 'trajectory.tum'))


def subscribe_all(recorder, mms_msgs):
    from diagnostic_msgs.msg import DiagnosticArray
    from nav_msgs.msg import Odometry, Path
    from sensor_msgs.msg import Image, PointCloud2
    from tf2_msgs.msg import TFMessage
    from visualization_msgs.msg import MarkerArray
    recorder.subscribe('/diagnostics', DiagnosticArray)
    recorder.subscribe('/tf', TFMessage)
    for topic, message_class in (('odometry', Odometry), ('path', Path), ('map', PointCloud2),
                                 ('static_cloud', PointCloud2), ('dynamic_cloud', PointCloud2),
                                 ('object_markers', MarkerArray), ('mask', Image),
                                 ('objects', mms_msgs.Objects)):
        recorder.subscribe(NODE + '/' + topic, message_class)


def play(session, recorder, player, node):
    """Plays the whole bag at the node's pace."""
    def keep_pace(index, _):
        session.wait('frame %d' % (index - AHEAD),
                     lambda: recorder.count(node + '/odometry') > index - AHEAD)
    frames = player.play(keep_pace)
    session.wait('the last frame', lambda: recorder.count(node + '/odometry') >= frames)


def compare_trajectories(recorder, reference, node=NODE):
    poses = {m.header.stamp.to_nsec(): position(m) for m in recorder.messages[node + '/odometry']}
    check(set(poses) == set(reference), 'every frame of mms run has a pose, and no other')
    max_error = max(distance(poses[stamp], reference[stamp]) for stamp in poses)
    travelled = max(distance(p, (0, 0, 0)) for p in reference.values())
    check(travelled > 0.1, 'the sensor moved: %.2f m' % travelled)
    check(max_error < 0.001, 'poses equal those of mms run: error %.6f mm' % (1000 * max_error))


def transforms(recorder):
    """Translations of the sensor by stamp in nanoseconds."""
    found = {}
    for message in list(recorder.messages['/tf']):
        frames = [(t.header.frame_id, t.child_frame_id) for t in message.transforms]
        assert frames == [('mms_world', 'camera_color_optical_frame'), ('map', 'mms_world')], frames
        t = message.transforms[0].transform.translation
        found[message.transforms[0].header.stamp.to_nsec()] = (t.x, t.y, t.z)
    return found


def compare_topics(session, recorder):
    # Each topic has its own connection: the message sent last may arrive first.
    for topic in ('path', 'map', 'static_cloud', 'dynamic_cloud', 'object_markers', 'mask',
                  'objects'):
        session.wait('a message on ' + topic, lambda: recorder.count(NODE + '/' + topic) > 0)
        print('ok: a message arrived on ' + topic)
    poses = {m.header.stamp.to_nsec(): position(m) for m in recorder.messages[NODE + '/odometry']}
    session.wait('a transform for every pose', lambda: set(poses) <= set(transforms(recorder)))
    sent = transforms(recorder)
    check(all(distance(poses[stamp], sent[stamp]) < 1e-9 for stamp in poses),
          '/tf and odometry agree')
    cloud = recorder.latest(NODE + '/static_cloud')
    check([f.name for f in cloud.fields] == ['x', 'y', 'z', 'rgb'] and
          len(cloud.data) == cloud.width * cloud.point_step and cloud.width > 1000,
          'static_cloud has %d points with colors' % cloud.width)
    objects = [o for m in recorder.messages[NODE + '/objects'] for o in m.objects]
    check(len(objects) > 0 and all(0 <= o.object_class <= 1 and o.size.z > 0 for o in objects),
          '%d objects with class and size' % len(objects))


def call(service):
    import rospy
    from std_srvs.srv import Trigger
    return rospy.ServiceProxy(NODE + '/' + service, Trigger)()


def compare_maps(folder):
    answer = call('save_map')
    check(answer.success, 'save_map: ' + answer.message)
    same = [open(os.path.join(folder, where, 'static_map.ply'), 'rb').read()
            for where in ('saved', 'camera')]
    check(same[0] == same[1], 'the saved map equals that of mms run to the bit')


def compare_lidar(session, recorder, build, folder, reference):
    from nav_msgs.msg import Odometry
    recorder.subscribe(LIDAR_NODE + '/odometry', Odometry)
    session.start('lidar', [os.path.join(build, 'mms_slam_node'), '__name:=' + LIDAR_NODE[1:],
                            '_sensor:=cloud_with_camera', '_publish_tf:=false'] + REMAPPINGS)
    player = Player(os.path.join(folder, 'lidar.bag'), lidar=True)
    session.wait('the LiDAR node', lambda: player.connected(LIDAR_NODE) and recorder.connected())
    play(session, recorder, player, LIDAR_NODE)
    compare_trajectories(recorder, reference, LIDAR_NODE)


def main():
    build, source = (os.path.abspath(folder) for folder in sys.argv[1:3])
    skip_without_ros()
    if not os.path.exists(os.path.join(build, 'mms_slam_node')):
        print('skipped: mms_slam_node was not built, libroscpp-dev is missing')
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder, Session(folder) as session:
        mms = os.path.join(build, 'mms')
        reference = make_reference(mms, folder, SCENE, 'camera')
        lidar_reference = make_reference(mms, folder, LIDAR_SCENE, 'lidar')
        mms_msgs = import_mms_msgs(source, os.path.join(folder, 'python'))
        session.start_master()
        import rospy
        rospy.init_node('node_test', disable_signals=True)
        recorder = Recorder()
        subscribe_all(recorder, mms_msgs)
        player = Player(os.path.join(folder, 'camera.bag'))
        session.start('slam', [os.path.join(build, 'mms_slam_node'), '_map_period:=0.1',
                               '_results:=' + os.path.join(folder, 'saved')] + REMAPPINGS)
        session.wait('the node', lambda: player.connected() and recorder.connected())
        session.wait('a diagnosis', lambda: diagnosis(recorder) is not None)
        missing = diagnosis(recorder)
        check(missing.level == 1 and 'depth images: none received' in missing.message and
              'camera_info: none received' in missing.message, 'reports missing inputs: ' +
              missing.message)

        play(session, recorder, player, NODE)
        session.wait('a diagnosis of frames',
                     lambda: 'localising' in diagnosis(recorder).message, 5)
        compare_trajectories(recorder, reference)
        compare_topics(session, recorder)
        compare_maps(folder)

        answer = call('reset')
        check(answer.success, 'reset: ' + answer.message)
        before = recorder.count(NODE + '/odometry')
        player.play(lambda *_: None, 1)
        session.wait('a frame', lambda: recorder.count(NODE + '/odometry') > before)
        check(distance(position(recorder.latest(NODE + '/odometry')), (0, 0, 0)) < 1e-12,
              'after a reset the first pose is the origin')

        compare_lidar(session, recorder, build, folder, lidar_reference)
        rospy.signal_shutdown('done')


main()
