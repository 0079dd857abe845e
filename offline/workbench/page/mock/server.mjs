// SPDX-License-Identifier: Apache-2.0
// Stands in for `plumb serve` while the page is developed: node mock/server.mjs -C CELL serve
// Verbs and figures are those of the program PLUMB (environment; else plumb of the PATH). Poses and the arm
// are computed roughly here: a page to look at, no numbers to trust. The policy is that of the server.
import { createHash, randomBytes } from "node:crypto";
import { execFile, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { basename, join, resolve } from "node:path";
import { tmpdir } from "node:os";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { armAt, jointsOf } from "./arm.mjs";

const folder = resolve(process.argv[process.argv.indexOf("-C") + 1]);
const plumb = process.env.PLUMB ?? "plumb";
const dist = join(dirname(fileURLToPath(import.meta.url)), "../dist");
const token = randomBytes(16).toString("hex");
const policy = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; frame-src 'self'";
const scratch = mkdtempSync(join(tmpdir(), "plumb-mock-"));
const jobs = [];
const sockets = new Set();
let state = 1, demo = 0;

const ask = (...args) => new Promise((done) => {
  execFile(plumb, ["-C", folder, ...args, "--json"], { cwd: folder, maxBuffer: 1e9 }, (_, out) => {
    try { done(JSON.parse(out)); } catch { done({ ok: false, result: null, error: { code: "", message: "no JSON" } }); }
  });
});

function tell(news) {
  const text = Buffer.from(JSON.stringify(news));
  const head = text.length < 126 ? Buffer.from([0x81, text.length]) : Buffer.from([0x81, 126, text.length >> 8, text.length & 255]);
  for (const socket of sockets) socket.write(Buffer.concat([head, text]));
}
setInterval(() => tell({ type: "ping" }), 10000).unref();
const changed = () => tell({ type: "state", state: ++state });

function rows() {
  const lines = readFileSync(join(folder, "measurements.csv"), "utf8").split("\n").filter((l) => l && !l.startsWith("#"));
  const head = lines[0].split(",");
  return lines.slice(1).map((line) => Object.fromEntries(line.split(",").map((v, i) => [head[i], v])));
}

async function runs() {
  const all = (await ask("runs")).result?.runs ?? [];
  const last = [...all].reverse().find((r) => r.current)?.run;
  return all.map((r) => ({ ...r, current: r.run === last }));
}

async function cell() {
  const toml = readFileSync(join(folder, "cell.toml"), "utf8");
  const read = (key) => new RegExp(`^${key} = "?([^"\\n#]*?)"?\\s*(#.*)?$`, "m").exec(toml)?.[1] ?? "";
  const all = await runs(), measured = existsSync(join(folder, "measurements.csv")) ? rows() : null;
  return {
    cell: { name: read("name"), serial: read("serial"), robot: "", folder, tolerance_mm: Number(read("tolerance_mm")) || 0.1, joints: jointsOf(toml), contexts: [] },
    toml, state, data: measured && { files: [{ name: "measurements.csv", rows: measured.length }], rows: measured.length, poses: measured.length, used: measured.length },
    runs: all, current_run: all.find((r) => r.current)?.run ?? null, command: `plumb -C ${basename(folder)}`, problem: null,
  };
}

async function poses(run) {
  const toml = readFileSync(join(folder, "cell.toml"), "utf8"), joints = jointsOf(toml);
  const stats = (await runs()).find((r) => r.run === run);
  const verdict = (await ask("compare", String(run))).result ?? {};
  const data = rows(), size = (stats?.held_out?.mean_mm ?? 0.1) / 0.8;
  const q = joints.map((_, j) => data.map((r) => Number(r[`q${j + 1}_deg`] ?? r[`q${j + 1}_mm`])));
  const point = [[], [], []], before = [[], [], []], after = [[], [], []];
  data.forEach((_, i) => {
    const at = q.map((c) => c[i] * Math.PI / 180), tip = armAt(toml, q.map((c) => c[i])).origins_mm.pop();
    const shape = [Math.sin(at[0]) + 0.3 * Math.cos(3 * at[1]), Math.cos(at[0] + (at[2] ?? 0)), Math.sin(at[1])];
    for (let k = 0; k < 3; ++k) {
      point[k].push(tip[k]);
      before[k].push(1.1 * shape[k] + 0.2 * Math.sin(7 * i + k));
      after[k].push(size * (0.5 * shape[k] + 0.5 * Math.sin(5 * i + 2 * k)));
    }
  });
  const norm = (e) => e[0].map((_, i) => Math.hypot(e[0][i], e[1][i], e[2][i]));
  const far = data.map((_, i) => i).filter((i) => point[2][i] > 1200);
  return {
    run, e: "measured - predicted, base frame [mm]", row: data.map((_, i) => i), pose: data.map((r) => r.pose), set: data.map((_, i) => (i % 5 === 0 ? "held" : "fit")),
    q, q_units: joints.map((j) => j.unit), point_mm: point, before_mm: before, after_mm: after, before_norm_mm: norm(before), after_norm_mm: norm(after), context: {},
    worst_region: { sentence: verdict.where ?? "Worst above 1200 mm.", rows: far }, reach_mm: 2300, verdict: verdict.verdict ?? "", verdict_head: verdict.verdict_head ?? "", verdict_class: verdict.verdict_class ?? "unknown",
  };
}

function startJob({ verb, args }) {
  const job = { job: jobs.length + 1, verb, args, command: `plumb -C ${basename(folder)} ${verb} ${args.join(" ")}`, state: "running", progress: [], exit: null, output: null, seconds: 0 };
  jobs.push(job);
  const begin = Date.now();
  const child = spawn(plumb, ["-C", folder, verb, ...args, "--json"], { cwd: folder });
  job.child = child;
  let out = "";
  child.stdout.on("data", (d) => { out += d; });
  child.stderr.on("data", (d) => { job.progress.push(...String(d).split("\n").filter(Boolean)); say(); });
  const say = () => { const { child: _, output: __, ...rest } = job; tell({ type: "job", ...rest }); };
  child.on("close", (code) => {
    job.exit = code;
    job.seconds = (Date.now() - begin) / 1000;
    try { job.output = JSON.parse(out); } catch { job.output = null; }
    job.state = code === null || code === 130 ? "stopped" : code === 0 ? "done" : "failed";
    changed();
    say();
  });
  return { job: job.job, command: job.command };
}

/** A made-up session: the correction follows the arm. */
function monitor() {
  const t = (Date.now() - demo) / 1000, wanted = 620 + 240 * Math.sin(t);
  const zero = { median_us: 11.2, p99_us: 18 + 2 * Math.sin(3 * t), worst_us: 61 };
  return {
    running: demo > 0, twin: demo > 0, folder: "deploy", folders: existsSync(join(folder, "deploy")) ? ["deploy"] : [], problem: null,
    limits: { max_correction_mm: 5, cycle_us: 4000 },
    status: demo === 0 ? null : {
      state: t > 3 ? "active" : "sync", mode: "full", fault: "none", status: "ok", lost: [], has_output: t > 3,
      correction: { wanted_um: wanted, wanted_urad: 300, applied_um: t > 3 ? wanted : 0, applied_urad: 0 },
      ages: { target_ms: 2.1, joints_ms: 2.1, controller_ms: 12, robot_ms: null }, counters: { cycles: Math.round(250 * t), targets: Math.round(240 * t), refused: 0 },
      link: { bus: "mem", state: "up", received: Math.round(900 * t) }, clock: { ticks: Math.round(250 * t), missed: 0 }, work: zero, wake: zero, model: { fingerprint: 2934187 },
    },
  };
}

const server = createServer(async (request, answer) => {
  const url = new URL(request.url, "http://127.0.0.1"), path = decodeURIComponent(url.pathname);
  const send = (code, type, body) => answer.writeHead(code, { "Content-Type": type, "Content-Security-Policy": policy, "Cache-Control": "no-store" }).end(body);
  const json = (body, code = 200) => send(code, "application/json", JSON.stringify(body));
  const refuse = (code, message) => json({ error: { code: "E-SERVE", message, help: "" } }, code);
  const body = await new Promise((done) => { const parts = []; request.on("data", (d) => parts.push(d)); request.on("end", () => done(Buffer.concat(parts))); });
  if (request.method !== "GET" && request.headers["x-plumb-token"] !== token) return refuse(403, "wrong token");
  let found;
  if (path === "/") return send(200, "text/html", readFileSync(join(dist, "index.html")));
  if (path === "/app.js") return send(200, "text/javascript", readFileSync(join(dist, "app.js")));
  if (path === "/app.css") return send(200, "text/css", readFileSync(join(dist, "app.css")));
  if (path === "/api/cell") return json(await cell());
  if (path === "/api/runs") return json({ runs: await runs() });
  if ((found = /^\/api\/runs\/(\d+)\/poses$/.exec(path))) return json(await poses(Number(found[1])));
  if ((found = /^\/api\/runs\/(\d+)\/frames$/.exec(path))) {
    const row = rows()[Number(url.searchParams.get("row"))], toml = readFileSync(join(folder, "cell.toml"), "utf8");
    return json({ row: 1, ...armAt(toml, jointsOf(toml).map((_, j) => Number(row[`q${j + 1}_deg`] ?? row[`q${j + 1}_mm`]))) });
  }
  if ((found = /^\/api\/runs\/(\d+)$/.exec(path))) {
    const row = (await runs()).find((r) => r.run === Number(found[1])), compared = (await ask("compare", found[1])).result;
    return json({ parameters: [], held_out: row?.held_out, verdict_error: row?.verdict_error, fit: row?.fit, noise_floor_mm: compared?.noise_floor_mm ?? null, effects: (row?.effects ?? []).map((effect) => ({ effect, joints: [] })) });
  }
  if (path === "/api/figures") return json({ figures: (await ask("plot", "--list")).result.figures.map((f) => ({ ...f, title: f.name })) });
  if ((found = /^\/fig\/([\w-]+)\.svg$/.exec(path))) {
    const file = join(scratch, `${found[1]}.svg`), run = found[1] === "evidence" ? [] : ["--run", url.searchParams.get("run") ?? "1"];
    const made = await ask("plot", found[1], "-o", file, "--force", "--width", url.searchParams.get("width") ?? "880", ...run);
    return made.ok ? send(200, "image/svg+xml", readFileSync(file)) : json({ error: made.error }, 400);
  }
  if (path === "/api/jobs" && request.method === "POST") return json(startJob(JSON.parse(body)));
  if (path === "/api/jobs") return json({ jobs: jobs.map(({ child: _, output: __, ...rest }) => rest) });
  if ((found = /^\/api\/jobs\/(\d+)$/.exec(path))) {
    const { child, ...job } = jobs[Number(found[1]) - 1] ?? {};
    if (request.method === "DELETE") child?.kill("SIGINT");
    return job.job ? json(job) : refuse(404, "no such job");
  }
  if (path === "/api/files") return json(readdirSync(folder).filter((n) => statSync(join(folder, n)).isFile()).map((name) => {
    const s = statSync(join(folder, name));
    return { name, bytes: s.size, changed: s.mtime.toISOString() };
  }));
  if ((found = /^\/api\/files\/([^/]+)$/.exec(path))) {
    const file = join(folder, basename(found[1]));
    if (request.method === "PUT") {
      if (existsSync(file) && url.searchParams.get("force") !== "1") return refuse(409, `${found[1]} is there already`);
      writeFileSync(file, body);
      changed();
      return json({});
    }
    return existsSync(file) ? send(200, file.endsWith(".svg") ? "image/svg+xml" : file.endsWith(".html") ? "text/html" : "text/plain", readFileSync(file)) : refuse(404, `there is no file ${found[1]}`);
  }
  if (path === "/api/monitor") {
    if (request.method === "POST") demo = JSON.parse(body).action === "start" ? Date.now() : 0;
    return json(monitor());
  }
  return refuse(404, "nothing here");
});
process.on("uncaughtException", (error) => { if (!["EPIPE", "ECONNRESET"].includes(error.code)) throw error; });
server.on("upgrade", (request, socket) => {
  if (new URL(request.url, "http://x").searchParams.get("token") !== token) return socket.end("HTTP/1.1 403 Forbidden\r\n\r\n");
  const key = createHash("sha1").update(`${request.headers["sec-websocket-key"]}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest("base64");
  socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${key}\r\n\r\n`);
  sockets.add(socket);
  for (const end of ["close", "error", "end"]) socket.on(end, () => sockets.delete(socket));
  socket.on("data", (data) => { if ((data[0] & 15) === 8) socket.end(); });
});
const port = process.argv.includes("--port") ? Number(process.argv[process.argv.indexOf("--port") + 1]) : 0;
server.listen(port, "127.0.0.1", () => console.log(`http://127.0.0.1:${server.address().port}/?token=${token}`));
