# What the commands take, in words: `usage` tells all of it, `help_of` what concerns one command.

usage() {
  cat <<'TEXT'
Prospect: looks at a scene, imagines what its actions would do, and acts on the best imagined plan or refuses.

  ./prospect demo                 install, build what it needs, run one episode with the bundled weights, show the plan
  ./prospect explain              look at the scene, search once and tell why: explain.html, nothing is carried out
  ./prospect test [--quick]       install, build, run the test suite (ctest); --asan and --tsan build with sanitizers
  ./prospect setup                install and build everything; without it, a program is built when it is first asked for

  ./prospect up                   start simulator, model server and planner workers in the background
  ./prospect run --seed S         one episode against the services that are up
  ./prospect predict --out DIR    what the scene that is up will look like after the next actions, as pictures; nothing is planned
  ./prospect status [--watch]     each of them: state, age of its last sign of life, queue, restarts
  ./prospect key                  the file of the deployment's key, which a robot needs
  ./prospect scale workers=N      more or fewer planner workers while they run
  ./prospect down                 stop them
  ./prospect check-robot          tries a robot in the simulator's place (or the simulator): it moves
  ./prospect doctor [--yes]       what this machine lacks for a deployment, and the commands that mend it
  ./prospect spy                  look at the bus with lcm-spy; --check SECONDS does it without a display
  ./prospect record FILE          record the bus (lcm-logger)
  ./prospect replay FILE          play a recording onto a bus of its own; commands are left out, so nothing moves

  ./prospect collect              make training trials
  ./prospect dataset info|pack|sheet|from-log|jigsaws
  ./prospect train                train the networks
  ./prospect tables               pictures and labels after one and two actions, of trained variants: the paper's two tables
  ./prospect figures              pictures of what the networks keep, imagine and judge, and their calibration curves
  ./prospect evaluate             closed loop on scenes that were never trained on; evaluate plans: which plans work; shifts: pictures
                                  unlike the known ones; calibrate, novelty: stored with the weights; refusals: whether promises hold
  ./prospect verify [--full]      measures the figures of docs/results.md for the bundled weights again, on fewer scenes or on all
  ./prospect oracle               what a world's scenes allow, by trying every plan
  ./prospect ceiling              how well what V, f and T are asked can be known at all, by carrying moments of test trials out again
  ./prospect takes                how far two takes of one action differ: the floor of a prediction's error
  ./prospect view                 a picture of a scene, at any size and from any camera
  ./prospect rebuild bus LOG      evaluations and rows of each search, from a recording; journal FILE: a worker's choices
  ./prospect bench search         rollouts/s, batches, decisions, bytes with 1 to 16 workers; bench simulated: without a bus
  ./prospect bench overhead       what a rollout costs
  ./prospect bench sim            how fast the worlds run on one core, and where the time goes
  ./prospect bench picks          picks and places in free space, without and with execution noise
  ./prospect bench train          images a second of each stage of training, and its share of the machine's matrix-multiply peak
  ./prospect messages             the message reference, from lcmtypes/
  ./prospect version

Options of demo, explain, up and run (what a deployment that is up was started with cannot be chosen by run):
  --task NAME       stacking, navigation or suturing             (default stacking; run: what is up)
  --seed N          scene                                        (default 2000000, a scene never trained on)
  --objects N       navigation: objects on the site, 4 to 7      (default 4)
  --legs N          navigation: objects to investigate, 3 to 5   (default 3)
  --tower N         stacking: blocks in the tower, 2 to 4        (default 2)
  --scene-file F    stacking: a scene of one's own, like config/scenes/stacking.yaml
  --video FILE      up: play it in the simulator's place: suturing, knot_tying or needle_passing
  --transcription F up: its gestures, as in JIGSAWS              (default: nobody knows them)
  --factor NAME     demo, explain, up: shift what the camera shows: light, camera, colour or noise; how far: --strength 1 to 5
  --novelty P       first pictures with a smaller p-value are refused as unlike what was trained on  (default 0.01; 0: none)
  --goal GOAL       as "on(red,blue)", "visited(barrel,pylon)"   (default: the task's own)
  --policy NAME     search, expert, collect or plan:A,B,...      (default search)
  --workers N       planner workers                              (default 2; suturing 0: its weights only predict pictures)
  --samples N       rollouts a search                            (default 30)
  --depth N         actions to look ahead                        (default: what remains of the plan)
  --weights PATH    weights file, its folder, or 'scripted'      (default: the bundled ones)
  --out DIR         where results go                             (default out/TASK-SEED; explain: out/explain)
  --what-if PLAN    explain: what the model expects of this plan, such as "align(green),grasp(green)"
  --refusal-threshold X  plans that score less are refused           (default: the weights' own)
  --refuse-at-most A  plans are refused so that at most this share of what can be done is     (default: the weights' threshold)
  --fail-at-most E    plans are refused so that at most this share of what is attempted fails, with probability 1 - D
  --delta D           (default 0.1)
  --retries N       times a plan that is lost may be begun anew, where the task allows it     (default 1)
  --surprise X      it is lost where a patch of the picture differs more than X from what was imagined  (default 0.3)
  --foreground      up: stay here, Ctrl-C stops everything
  --no-simulator    up: a robot takes its place
  --no-reset        run, explain: take the scene as it is, as on a robot
  --verbose         demo, explain, run: log lines of the searches, too
  --bus URL         LCM bus        (default $LCM_DEFAULT_URL, or port 7667; demo, and explain with nothing up: one of their own)
  --key FILE        the key of a deployment that another machine or user has up (up: use it instead of making one)
  --open            demo, explain, up: no key, so that whoever can send on the bus can move the robot
  --chaos FAULTS    for tests: a bad network, such as drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1

Every other command lists its own options: ./prospect COMMAND --help.
Exit codes: 0 success, 2 usage, 3 refused, 4 failed or stopped, 5 figure out of tolerance, 10 weights, 11 bus, 12 bus in use,
13 disk, 14 data file, 15 service lost, 16 time-out, 130 interrupted.
TEXT
}

# help_of COMMAND: its lines, and those options that do not name other commands alone.
help_of() {
  local command=$1
  usage | awk -v command="$command" '
    /^Options of / { options = index($0, command) > 0; if (options) print "\nOptions:"; next }
    /^Every other/ { exit }
    !options && $1 == "./prospect" { said = $2 == command; if (said) print; next }
    !options && said && /^     / { print; next }
    !options { said = 0; next }
    /^  --/ {
      words = $0
      sub(/^  --[a-z-]+( [A-Z]+)? +/, "", words)
      shown = 1
      if (match(words, /^(demo|explain|up|run)(, (demo|explain|up|run))*: /)) shown = index(" " substr(words, 1, RLENGTH), " " command) > 0
    }
    shown'
}
