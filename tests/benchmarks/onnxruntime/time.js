// node time.js MODEL.onnx ACTIONS: what a row of Expand takes in ONNX Runtime, on one thread, in processor time; medians of 7.
// With ANSWERS=1 the answers to a fixed question instead, as JSON.
const ort = require('onnxruntime-node');
const [model, actions] = [process.argv[2], Number(process.argv[3])];
const STATE = [8, 8, 8];
const size = STATE.reduce((a, b) => a * b);

// The same numbers wherever they are asked for: multiples of 1/1024 from 0 to 1.
function numbers(count, seed) {
  let x = seed;
  return Float32Array.from({length: count}, () => (x = x * 16807 % 2147483647, x % 1024 / 1024));
}

function question(rows) {
  const action = new Float32Array(rows * actions);
  for (let i = 0; i < rows; i++) action[i * actions + i % actions] = 1;
  return {
    h0: new ort.Tensor('float32', numbers(rows * size, 1), [rows, ...STATE]),
    h: new ort.Tensor('float32', numbers(rows * size, 2), [rows, ...STATE]),
    action: new ort.Tensor('float32', action, [rows, actions]),
  };
}

function processorMs() {
  const {user, system} = process.cpuUsage();
  return (user + system) / 1000;
}

async function msOfRow(session, rows) {
  const asked = question(rows), times = Math.max(4, Math.round(256 / rows)), tries = [];
  for (let k = 0; k < 8; k++) {  // the first warms up
    const begin = processorMs();
    for (let i = 0; i < times; i++) await session.run(asked);
    if (k > 0) tries.push((processorMs() - begin) / (times * rows));
  }
  return tries.sort((a, b) => a - b)[3];
}

async function main() {
  const session = await ort.InferenceSession.create(
      model, {intraOpNumThreads: 1, interOpNumThreads: 1, executionMode: 'sequential', graphOptimizationLevel: 'all'});
  if (process.env.ANSWERS) {
    const answers = await session.run(question(1));
    console.log(JSON.stringify(Object.fromEntries(Object.entries(answers).map(([name, t]) => [name, Array.from(t.data)]))));
    return;
  }
  for (const rows of [1, 4, 16, 64]) console.log(`batch ${rows}: ${(await msOfRow(session, rows)).toFixed(3)} ms a row`);
}

main();
