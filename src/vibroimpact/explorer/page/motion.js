// One motion: over time, in the phase plane, its force, its spectrum, and the mass that moves.

import { Chart, element, range } from "./plot.js";

// Of a second of the rig in a second of the page, so that impacts can be seen; and seconds of the page
// that a forcing cycle takes at least.
const SLOW = 0.25;
const CYCLE = 0.5;
// The same where time has no unit: each cycle takes as long.
const EACH = 2;
// A page that was not looked at for longer (s) goes on where it was.
const PAUSE = 0.25;
// Of a knock: how loud the hardest is, and what is no longer heard.
const LOUD = 0.25;
const FAINT = 0.003;

export class Motion {
  constructor() {
    const views = document.getElementById("views");
    this.time = new Chart(views, { name: "Displacement over time, with the faces of the stops", wide: true });
    this.phase = new Chart(views, { name: "Phase portrait between the stops" });
    this.force = new Chart(views, { name: "Force loop" });
    this.lines = new Chart(views, { name: "Spectrum", ylog: true, wide: true });
    for (const chart of [this.time, this.phase, this.force, this.lines]) chart.redraw = () => this.draw();
    this.verdict = document.getElementById("verdict");
    this.rig = element("svg", { role: "img", "aria-label": "The mass between its stops, in slow motion", viewBox: "0 0 400 84", preserveAspectRatio: "none" }, document.getElementById("stage"));
    this.parts = Object.fromEntries(
      [["left", "stop"], ["right", "stop"], ["mass", "mass"], ["spark", "hit"], ["ground", "axis"]].map(([name, kind]) => [name, element("path", { class: kind }, this.rig)]),
    );
    this.play = document.getElementById("play");
    this.play.checked = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.sound = document.getElementById("sound");
    this.sound.addEventListener("change", () => this.listen(this.sound.checked));
    this.passed = 0; // of the rig's time (s)
    requestAnimationFrame((now) => this.frame(now));
  }

  show(picture) {
    this.picture = picture;
    if (picture.words) this.verdict.textContent = picture.words;
    // What takes care is that of the motion before, until the knob is let go.
    for (const one of [this.verdict, this.lines.svg]) one.classList.toggle("old", !picture.words);
    this.draw();
  }

  draw() {
    const { picture } = this;
    if (!picture || picture.none) return;
    const { time, displacement: u, velocity, right, left, touching, gaps, force, axes } = picture;
    const touched = (i) => Object.values(touching).some((one) => one[i]);
    const faces = [right, left].filter(Boolean);
    this.time.axes([time[0], time.at(-1)], range([u, ...faces]), axes.displacement, axes.time);
    for (const [name, face] of [["right", right], ["left", left]])
      if (face) this.time.line(name, "wall", time, face);
      else this.time.drop(name);
    this.time.line("u", "plain", time, u);
    this.time.line("touch", "touch", time, u.map((value, i) => (touched(i) ? value : null)));
    const across = range([u, Object.values(gaps).filter((gap) => gap !== null)]);
    this.across = across;
    this.phase.axes(across, range([velocity], { even: true }), axes.velocity, axes.displacement);
    for (const side of ["right", "left"])
      if (gaps[side] === null) this.phase.drop(side);
      else this.phase.upright(side, "wall", gaps[side]);
    this.phase.line("orbit", "plain", u, velocity);
    this.phase.line("touch", "touch", u, velocity.map((value, i) => (touched(i) ? value : null)));
    this.force.axes(across, range([force]), axes.force, axes.displacement);
    this.force.line("loop", "plain", u, force);
    if (picture.spectrum) this.spectrum(picture.spectrum, axes);
  }

  spectrum({ frequency, displacement }, axes) {
    const most = Math.max(...displacement.filter((value) => value !== null));
    if (!(most > 0)) return;
    const low = most * 1e-5;
    this.lines.axes([0, frequency.at(-1) * 1.03], [low, most * 2], axes.displacement, axes.spectrum);
    let d = "";
    frequency.forEach((f, i) => {
      if (displacement[i] > low) d += `M${this.lines.toX(f)} ${this.lines.toY(low)}V${this.lines.toY(displacement[i])}`;
    });
    this.lines.path("lines", "line plain", d);
  }

  // The mass where it is now; time goes on while it is looked at.
  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const since = Math.min((now - (this.before ?? now)) / 1000, PAUSE);
    this.before = now;
    const { picture } = this;
    if (!picture || !this.across || document.hidden) return;
    const { time, displacement, right, left, touching } = picture;
    const length = time.at(-1) - time[0];
    if (!(length > 0)) return;
    const pace = picture.seconds ? Math.min(SLOW, picture.cycle / CYCLE) : picture.cycle / EACH;
    const begun = this.passed;
    if (this.play.checked) this.passed += pace * since;
    const share = (this.passed / length) % 1;
    const i = Math.min(Math.floor(share * (time.length - 1)), time.length - 1);
    const [low, high] = this.across;
    const half = 26;
    const x = (value) => half + 24 + ((value - low) / (high - low)) * (400 - 2 * (half + 24));
    const at = x(displacement[i] ?? 0);
    this.parts.ground.setAttribute("d", "M0 70H400");
    this.parts.mass.setAttribute("d", `M${at - half} 28h${2 * half}v42h${-2 * half}z`);
    this.parts.right.setAttribute("d", right ? `M${x(right[i]) + half} 34h400v30h-400z` : "");
    this.parts.left.setAttribute("d", left ? `M${x(left[i]) - half} 34h-400v30h400z` : "");
    const edge = touching.right?.[i] ? half - 1 : touching.left?.[i] ? -half - 5 : null;
    this.parts.spark.setAttribute("d", edge === null ? "" : `M${at + edge} 28h6v42h-6z`);
    if (this.sound.checked && this.audio?.state === "running") this.beat(begun, this.passed, pace);
  }

  // A browser lets a page be heard only from where the user has asked for it.
  listen(on) {
    this.audio ??= new AudioContext();
    if (on) this.audio.resume();
    else this.audio.suspend();
  }

  // A short tone for each contact that begins within this stretch of the rig's time.
  beat(begun, ended, pace) {
    const { time, velocity, hits } = this.picture;
    const length = time.at(-1) - time[0];
    const fastest = Math.max(...velocity.map(Math.abs));
    for (const hit of hits ?? []) {
      const when = hit.time - time[0];
      // In how many periods from the first it comes within the stretch for the first time.
      for (let n = Math.ceil((begun - when) / length); when + n * length < ended; n++)
        this.knock(hit.stop, hit.speed / fastest, (when + n * length - begun) / pace);
    }
  }

  // A share of the mass's largest speed is how loud it is, so that a grazing contact is hardly heard.
  knock(stop, share, delay) {
    const loudness = LOUD * Math.min(share, 1);
    if (!(loudness > FAINT)) return;
    const start = this.audio.currentTime + delay;
    const [tone, gain] = [this.audio.createOscillator(), this.audio.createGain()];
    tone.frequency.value = stop === "right" ? 330 : 220;
    gain.gain.setValueAtTime(loudness, start);
    gain.gain.exponentialRampToValueAtTime(1e-4, start + 0.12);
    tone.connect(gain).connect(this.audio.destination);
    tone.start(start);
    tone.stop(start + 0.13);
  }
}
