"""How check_printed.py runs what the documents print. The first rule whose pattern fits a whole command holds.

A command without a rule is run as it stands: it must end by itself, with exit status 0. A rule is for the others:

  skip     the reason why it cannot run here: it is not run
  until    it runs for ever: a topic that is published, a command that returns when it has done enough, or words (re.compile) of its
           output. Then it gets SIGINT
  stays    ... but only at the end of its section, since what follows needs it
  beside   what runs meanwhile, as another terminal would: printed commands that have a rule with `until`. Others are stopped before
  drive    a printed command that goes on, as soon as `until` holds, until its own `until` does
  then     a command that must succeed afterwards
  says     words that its output must have (a regular expression)
"""

import collections
import pathlib
import re
import shutil

Rule = collections.namedtuple('Rule', 'pattern skip until stays beside drive then says', defaults=(None, None, False, None, None, None, None))

DOCUMENTS = ('README.md', 'CONTRIBUTING.md', 'doc/reference.md', 'doc/time.md', 'doc/contact.md', 'doc/collision.md', 'doc/physics.md', 'doc/report.md',
             'doc/sensors.md', 'doc/helm.md', 'doc/craft.md', 'doc/manoeuvres.md', 'doc/rviz.md', 'doc/api.md', 'doc/accuracy.md', 'doc/tutorial.md', 'doc/cookbook.md',
             'doc/web.md', 'doc/python.md', 'doc/identify.md', 'doc/install.md', 'doc/studies.md')
# Sections that begin in a terminal where no setup.bash was read. The others begin with that of scripts/demo.
BARE_SECTIONS = ('Two commands', 'Build it yourself', 'Build and test')
# Programs of a reader's own machine, which need not be here.
READERS_PROGRAMS = ('docker', 'node', 'rviz', 'ssh', 'xdg-open')
# The languages of blocks that nobody runs; every other one is a file, whose name in backquotes and a colon precede it.
TEXTS = ('', 'text', 'mermaid')
# Blocks that another check runs: scripts/check_python does.
CHECKED_ELSEWHERE = {'doc/python.md': ('python',)}

# Up to this section of the first document everything runs in order. What it built is there then, and the other documents run beside the rest.
LAST_IN_ORDER = 'Build it yourself'
# Sections in which commands are named, not printed to be run.
UNREAD_SECTIONS = ('Traps of ROS 1 on Debian',)

ROSCORE = 'roscore -p ${ROS_MASTER_URI##*:}'
SIMULATION = 'roslaunch hovercraft_sim sim.launch'
FORWARDS = 'rostopic pub -r 10 /hovercraft/thrust/rear std_msgs/Float64 3.0'
# Returns when the craft has moved by more than 0.2 m.
MOVED = 'rostopic echo -n 1 --filter "m.pose.position.x > 0.2" /hovercraft/pose'
# rosrun finds each program once, and asks nothing.
ROSRUN = ('for name in hold_heading.py plot_run.py simulate; do '
          'rosrun --prefix echo hovercraft_sim $name | grep -x "/.*/$name" || exit 1; done')
SCRIPTS_TEST = 'scripts/test runs it'
# scripts/test installs no RViz.
NO_RVIZ = None if all(map(shutil.which, ('rviz', 'Xvfb', 'import'))) else 'it needs rviz, xvfb and imagemagick, which are not here'
# Debian 12 alone installs what builds the package of Python.
NO_PYTHON = None if pathlib.Path('/usr/include/pybind11/pybind11.h').exists() else 'it needs pybind11, which is not here'
NAMED = 'a name in a sentence: nothing to run'
RECORDS = 'rosnode info /record | grep /hovercraft/state'
HAS_THRUSTS = 'rosbag info flight.bag | grep /hovercraft/thrust/rear'

RULES = (
    # README.md
    Rule(r'scripts/demo', then='. build_release/devel/setup.bash; ' + ROSRUN, says='top speed'),
    Rule(r'scripts/test.*|python3 scripts/check_printed\.py .*', skip='it is what runs this'),
    Rule(r'roslaunch hovercraft_sim sim\.launch', until='/hovercraft_sim/scenario', stays=True),
    Rule(r'rostopic pub -r 10 /hovercraft/thrust/rear .*', until=MOVED),
    Rule(r'rostopic echo /hovercraft/pose/pose/position', until=re.compile(r'x: ([1-9]|0\.[1-9])'), beside=(SIMULATION, FORWARDS)),
    Rule(r'rostopic pub -r 10 /hovercraft/thrust hovercraft_sim/ThrustCommand .*', beside=(SIMULATION,),
         until='rostopic echo -n 1 --filter "m.right.commanded == 0.4" /hovercraft/engines'),
    Rule(r'rosrun hovercraft_sim simulate .* --output reference\.bag',
         then='rosrun hovercraft_sim compare reference.bag examples/flight_test/reference.bag'),
    Rule(r'\. (devel|~/hovercraft)/setup\.bash', then=ROSRUN),
    Rule(r'roslaunch hovercraft_sim sim\.launch record:=true .*', beside=(), until=RECORDS, drive=FORWARDS, then=HAS_THRUSTS),
    Rule(r'roslaunch hovercraft_sim record\.launch .*', beside=(SIMULATION,), until=RECORDS, drive=FORWARDS, then=HAS_THRUSTS),
    Rule(r'replay flight\.bag', says='identical'),
    Rule(r'roslaunch hovercraft_sim replay_commands\.launch .*', beside=(SIMULATION,)),
    Rule(r'roscore .*', until='/rosout_agg', stays=True),
    Rule(r'markers_node .*', beside=(ROSCORE,), until='/hovercraft_markers/markers', stays=True),
    Rule(r'rviz .*', skip='it opens a window'),
    Rule(r'rosservice call /hovercraft_sim/…|rosbag (record|reindex)|rosrun hovercraft_sim|simulate --(contacts|cushion|sensors) (FILE\.csv|DIR)|simulate --(hold|pilot|set|truth-odom truth/odom)|replay --version|rosbag fix old\.bag new\.bag|rosparam delete /use_sim_time',
         skip=NAMED),
    Rule(r'roslaunch hovercraft_sim sim\.launch set:=.*', beside=(), until='/hovercraft_sim/scenario'),
    # doc/cookbook.md
    Rule(r'roslaunch two_craft\.launch .*', beside=(), until='rostopic echo -n 1 --filter "m.twist.linear.x > 0.9" /blue/twist', stays=True),
    Rule(r'rostopic echo -n 1 /(red|blue)/twist/twist', beside=('roslaunch two_craft.launch folder:=$PWD',)),
    Rule(r'roslaunch hovercraft_sim sim\.launch scenario:=\$PWD/my_craft\.yaml', beside=(), until='/hovercraft_sim/scenario'),
    # doc/tutorial.md
    Rule(r'python3 scripts/plot_tutorial\.py .*', skip='it takes a minute and more'),
    # CONTRIBUTING.md
    Rule(r'cmake .* build/mine .*|build/mine/.*', skip='scripts/test builds and runs the same in build_release'),
    Rule(r'cmake .* build_release -DCATKIN_ENABLE_TESTING=ON|cmake .* --target hovercraft_sim_test_math .*|build_release/.*/hovercraft_sim_test_math .*',
         skip=SCRIPTS_TEST),
    Rule(r'clang-format-14 -i .*|scripts/(fuzz|mutate) .*', skip=NAMED),
    Rule(r'(sudo )?scripts/(try_in_chroot|determinism|package|check_package|check_container).*', skip='it makes a bare Debian from the network, as root'),
    Rule(r'build/determinism/.* --record', skip='scripts/determinism, as root, has built it'),
    # doc/install.md
    Rule(r'sudo apt-get (install .*build/packages.*|purge .*)', skip='scripts/check_package does it in a bare Debian'),
    Rule(r'bloom-generate .*', skip='it needs the network'),
    Rule(r'docker (build|run) .*', skip='there is no container runtime; scripts/check_container does the same in bare trees'),
    Rule(r'scripts/(package|check_package) SUITE.*|new_package NAME FOLDER|.*rosrun\s+hovercraft_sim new_package', skip=NAMED),
    # doc/craft.md
    Rule(r'roslaunch hovercraft_sim sim\.launch scenario:=\$PWD/config/lift_fan\.yaml', beside=(), until='/hovercraft_sim/scenario', stays=True),
    Rule(r'rostopic pub -1 /rc5/actuators/lift .*', beside=('roslaunch hovercraft_sim sim.launch scenario:=$PWD/config/lift_fan.yaml',)),
    # doc/manoeuvres.md
    Rule(r'rosrun hovercraft_sim pilot .*', beside=('roslaunch hovercraft_sim sim.launch lockstep:=true',)),
    # doc/sensors.md
    Rule(r'roslaunch hovercraft_sim sim\.launch truth_odom:=truth/odom', beside=(), until='/hovercraft/truth/odom'),
    Rule(r'rosbag play --clock run\.bag', beside=(ROSCORE,)),
    Rule(r'compare filtered\.bag .*', skip='what a filter said: there is none here'),
    Rule(r'roslaunch hovercraft_sim sim\.launch scenario:=\$PWD/config/senses\.yaml map:=true .*', beside=(), until='rostopic echo -n 1 /map/info'),
    # doc/helm.md
    Rule(r'rosrun hovercraft_sim teleop\.py .*', skip='it reads the keys of a terminal: a test types them'),
    Rule(r'rosparam load config/helm/joy\.yaml .*', beside=(ROSCORE,)),
    Rule(r'rosrun hovercraft_sim joy_teleop\.py .*', beside=(ROSCORE,), until='/hovercraft/cmd_vel'),
    Rule(r'roslaunch hovercraft_sim autonomy\.launch', beside=(), until='rostopic echo -n 1 --filter "m.pose.pose.position.x > -2" /hovercraft/truth/odom'),
    # doc/time.md
    Rule(r'rosrun dynamic_reconfigure dynparam .*', beside=(SIMULATION,)),
    Rule(r'rosservice call .*', beside=(SIMULATION,), says='success: True'),
    Rule(r'roslaunch hovercraft_sim sim\.launch lockstep:=true', beside=(), until='/hovercraft_sim/scenario', stays=True),
    Rule(r'rosrun hovercraft_sim hold_heading(\.py)?( .*)?', beside=('roslaunch hovercraft_sim sim.launch lockstep:=true',),
         until='rostopic echo -n 20 /hovercraft/commands'),
    Rule(r'rosbag record .*', beside=(SIMULATION,), until='rostopic echo -n 50 /hovercraft/state'),
    Rule(r'rosrun hovercraft_sim replay run\.bag', says='identical'),
    Rule(r'rostest .*', beside=(), says='RESULT: SUCCESS'),
    # doc/craft.md, doc/rviz.md
    Rule(r'scripts/screenshot_rviz( .*)?', skip=NO_RVIZ),
    Rule(r'scripts/check_(example|page) build_release( doc)?', skip=SCRIPTS_TEST),
    Rule(r'roslaunch hovercraft_sim sim\.launch rviz:=true', skip='it opens a window'),
    # doc/web.md
    Rule(r'roslaunch hovercraft_sim web\.launch( address:=.*)?', beside=(), until='rosparam get /web/bound_port'),
    Rule(r'rosrun hovercraft_sim web_node .*', beside=(SIMULATION,), until='rosparam get /web/bound_port'),
    Rule(r'ssh -L .*', skip='there is no other machine'),
    # doc/identify.md
    Rule(r'rosrun hovercraft_sim identify\.py .*', skip=NO_PYTHON, says=r'drag\.linear\[0\] +0\.8 '),
    Rule(r'identify\.py run_1\.bag run_2\.bag .*|scripts/check_python .*', skip='it takes minutes; scripts/check_python does the like'),
    # doc/studies.md
    Rule(r'rosrun hovercraft_sim study\.py config/studies/heading\.yaml .*|rosrun hovercraft_sim report run_12\.bag', skip=NO_PYTHON),
    Rule(r'dask-(scheduler|worker) .*|sbatch .*|rosrun hovercraft_sim study\.py STUDY\.yaml .*', skip='there are no other machines'),
    # doc/report.md
    Rule(r'xdg-open .*', skip='it opens a window'),
    Rule(r'node web/.*|cd web && .*', skip="it needs npm's network; scripts/check_page does it"),
)
