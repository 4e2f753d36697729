// playground_page.mjs PAGE SURFMINK MODULES: docs/playground.html in headless Chromium, driven by playwright-core,
// which npm has put into MODULES. With hands: mouse, keys, fingers. After each the page's numbers must be those of the
// command SURFMINK for the table that the page hands out, to 1e-12.
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [page, surfmink, modules] = process.argv.slice(2);
const { chromium } = createRequire(resolve(modules) + "/")("playwright-core");
const address = "file://" + resolve(page);
const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

let passed = 0,
  failed = 0;
function check(name, ok, said = "") {
  if (ok) passed++;
  else {
    failed++;
    console.log("FAILED " + name, said);
  }
}

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu"] });

// Waits up to ten seconds. (What playwright has for this evaluates text, which the policy of the page forbids.)
async function until(tab, condition, value) {
  for (let i = 0; i < 500 && !(await tab.evaluate(condition, value)); i++) await tab.waitForTimeout(20);
  if (!(await tab.evaluate(condition, value))) throw Error("waited in vain for " + condition);
}

// A tab of its own, that must not ask for anything but the page, and not complain.
async function open(options = {}) {
  const context = await browser.newContext({
    viewport: { width: 1280, height: 900 },
    reducedMotion: "reduce",
    ...options,
  });
  const tab = await context.newPage();
  tab.said = [];
  tab.asked = [];
  tab.on("console", (message) => tab.said.push(message.text()));
  tab.on("pageerror", (error) => tab.said.push(error.message));
  tab.on("request", (request) => {
    if (request.url() !== address && !request.url().startsWith("data:")) tab.asked.push(request.url());
  });
  await tab.goto(address);
  await until(tab, () => document.getElementById("mu-1") !== null);
  return tab;
}

async function close(tab, name) {
  check(name + ": nothing in the console", tab.said.length === 0, tab.said);
  check(name + ": no request", tab.asked.length === 0, tab.asked);
  await tab.context().close();
}

// Tables are written when the hand has rested for a moment; here it has.
const settle = (tab) => tab.evaluate("rest()");

async function numbers(tab) {
  await settle(tab);
  return tab.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("#table [data-value]")].map((td) => [td.id, Number(td.dataset.value)]),
    ),
  );
}

// The table for the command line, and the command that the page names.
async function agrees(tab, name) {
  const now = await numbers(tab);
  const [table, words] = await tab.evaluate(() => [
    document.getElementById("tsv").value,
    document.getElementById("command").textContent,
  ]);
  let worst = 0;
  for (const [transport, prefix] of [
    ["corrected", "mu-"],
    ["parallel", "classical-"],
  ]) {
    const options = words.split(" ").slice(1, -1); // without the names of the command and of the file
    const said = execFileSync(surfmink, [...options, "--transport", transport], { input: table, encoding: "utf8" });
    const [head, row] = said
      .trimEnd()
      .split("\n")
      .map((line) => line.split("\t"));
    const value = (key) => Number(row[head.indexOf(key)]);
    for (let p = 1; p <= 12; p++) worst = Math.max(worst, Math.abs(now[prefix + p] - value("mu_" + p)));
    worst = Math.max(worst, Math.abs(now.length / value("L") - 1), Math.abs(now.turning - value("S")));
    if (now.area !== undefined) worst = Math.max(worst, Math.abs(now.area / value("area") - 1));
  }
  check(name + ": the numbers of the command", Object.keys(now).length >= 28 && worst <= 1e-12, worst);
  return now;
}

// Where a corner stands, in the window.
const cornerPlace = (tab, i) =>
  tab.evaluate((i) => {
    const box = document.getElementById("corners").children[i].getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  }, i);
const outlineOf = (tab) => tab.evaluate(() => JSON.stringify(outline));
const differ = (a, b) => Math.max(...Object.keys(a).map((key) => Math.abs(a[key] - b[key])));
const kind = (tab, name) => tab.click(`#kinds label:has([value=${name}])`);

// --- mouse, on each surface ------------------------------------------------------------------------------------------
{
  const tab = await open();
  let before = await agrees(tab, "as it opens");
  check(
    "it opens with the octant: a triangle, or classically a square",
    Math.abs(before["mu-3"] - 1) < 1e-12 && before["mu-4"] < 1e-12 && Math.abs(before["classical-4"] - 1) < 1e-12,
    before,
  );
  const verdict = await tab.textContent("#verdict");
  check("and says so", /a triangle/.test(verdict) && /a square/.test(verdict), verdict);
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await kind(tab, name);
    before = await agrees(tab, name);
    const [x, y] = await cornerPlace(tab, 1),
      dx = await tab.evaluate(() => (toScreen(cornerAt(1))[0] > width / 2 ? -17 : 17));
    await tab.mouse.move(x, y);
    await tab.mouse.down();
    await tab.mouse.move(x + dx / 2, y - 14, { steps: 4 });
    const middle = await tab.evaluate(() => found.mu[3]);
    await tab.mouse.move(x + dx, y - 21, { steps: 4 });
    await tab.mouse.up();
    if (name === "plane")
      await until(tab, (mu) => Number(document.getElementById("mu-3").dataset.value) !== mu, before["mu-3"]);
    const after = await agrees(tab, name + ", a corner dragged");
    check(
      name + ": values change",
      differ(before, after) > 1e-3 && middle !== after["mu-3"] && middle !== before["mu-3"],
    );
    const [u, v] = await cornerPlace(tab, 1);
    check(name + ": the corner stays under the pointer", Math.hypot(u - x - dx, v - y + 21) < 1.5, [u - x, v - y]);
    await tab.click("#undo");
    check(name + ": one undo takes the drag back", differ(before, await numbers(tab)) === 0);
    await tab.click("#redo");
    check(name + ": redo", differ(after, await numbers(tab)) === 0);

    // the classical numbers depend on the edge that arrows are carried to; the corrected ones do not
    await tab.click("#base-more");
    const other = await agrees(tab, name + ", carried to another edge");
    const off = (prefix) =>
      Math.max(...Array.from({ length: 12 }, (_, p) => Math.abs(other[prefix + (p + 1)] - after[prefix + (p + 1)])));
    check(name + ": mu does not depend on that edge", off("mu-") < 1e-12, off("mu-"));
    check(
      name + ": classically it does where there is curvature",
      name === "plane" ? off("classical-") < 1e-12 : off("classical-") > 1e-3,
    );

    // background: the view turns, numbers stay
    const places = await cornerPlace(tab, 0);
    const stage = await tab.locator("#stage").boundingBox();
    await tab.mouse.move(stage.x + 20, stage.y + 20);
    await tab.mouse.down();
    await tab.mouse.move(stage.x + 60, stage.y + 30, { steps: 3 });
    await tab.mouse.up();
    const turned = await cornerPlace(tab, 0);
    check(name + ": the background turns the view", Math.hypot(turned[0] - places[0], turned[1] - places[1]) > 3);
    check(name + ": and no number", differ(other, await numbers(tab)) === 0);
    await tab.mouse.wheel(0, -300);
    const scale = await tab.evaluate(() => view.scale);
    await tab.mouse.wheel(0, 300);
    check(name + ": the wheel zooms", scale > 1.3 * (await tab.evaluate(() => view.scale)));

    await tab.click("#fit");
    const count = await tab.locator("#corners button").count();
    const [a, b] = [await cornerPlace(tab, 0), await cornerPlace(tab, 1)];
    await tab.mouse.dblclick(
      ...(await tab.evaluate(() => {
        const i = found.edgeOf.indexOf(0) + (outline.base === 0 ? 0 : found.edgeOf.filter((e) => e === 0).length >> 1);
        const box = stage.getBoundingClientRect(),
          p = at(found.point, i),
          q = at(found.point, (i + 1) % found.edgeOf.length);
        const [x, y] = toScreen(times(plus(p, q), 0.5));
        return [box.x + 1 + x, box.y + 1 + y];
      })),
    );
    check(
      name + ": a double click on a line adds a corner",
      (await tab.locator("#corners button").count()) === count + 1,
      [a, b],
    );
    await agrees(tab, name + ", a corner added");
    await tab.mouse.dblclick(...(await cornerPlace(tab, 1)));
    check(name + ": a double click on a corner removes it", (await tab.locator("#corners button").count()) === count);
    await agrees(tab, name + ", and removed");
  }
  for (const name of ["ellipsoid", "torus"]) {
    await kind(tab, name);
    const before = await numbers(tab);
    await tab.locator("#bend-value").fill(name === "torus" ? "0.6" : "1.4");
    check(name + ": its shape can be changed", differ(before, await agrees(tab, name + ", another shape")) > 1e-4);
  }
  await close(tab, "mouse");
}

// --- keys ------------------------------------------------------------------------------------------------------------
{
  const tab = await open();
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await kind(tab, name);
    if (name === "sphere") await tab.selectOption("#sides", "5");
    await tab.locator(".skip").focus();
    await tab.keyboard.press("Tab");
    const focused = () => tab.evaluate(() => document.activeElement.getAttribute("aria-label"));
    check(name + ": Tab comes to the first corner", /^Corner 1 of 5/.test(await focused()), await focused());
    await tab.keyboard.press("Tab");
    check(name + ": and goes on to the next", /^Corner 2 of 5/.test(await focused()), await focused());
    check(
      name + ": the focus can be seen",
      (await tab.evaluate(() => getComputedStyle(document.activeElement).outlineStyle)) === "solid",
    );
    const before = await numbers(tab),
      [x, y] = await cornerPlace(tab, 1);
    await tab.keyboard.press("ArrowRight");
    await tab.keyboard.press("ArrowDown");
    const after = await agrees(tab, name + ", moved by arrows"),
      [u, v] = await cornerPlace(tab, 1);
    check(name + ": an arrow moves the corner by 8 pixels", Math.hypot(u - x - 8, v - y - 8) < 1, [u - x, v - y]);
    check(name + ": values change", differ(before, after) > 1e-4);
    await tab.keyboard.press("Shift+ArrowRight");
    check(name + ": with Shift by one", Math.abs((await cornerPlace(tab, 1))[0] - u - 1) < 0.5);
    await tab.keyboard.press("Control+z");
    check(name + ": Ctrl+Z", differ(before, await numbers(tab)) === 0);
    await tab.keyboard.press("Control+y");
    await tab.keyboard.press("Insert");
    check(name + ": Insert adds a corner, which is in focus", /^Corner 3 of 6/.test(await focused()), await focused());
    await agrees(tab, name + ", one inserted");
    await tab.keyboard.press("Delete");
    check(name + ": Delete removes it", (await tab.locator("#corners button").count()) === 5);
    const here = await cornerPlace(tab, 1),
      outline = await outlineOf(tab);
    await tab.keyboard.press("d");
    await tab.keyboard.press("s");
    await tab.keyboard.press("+");
    const there = await cornerPlace(tab, 1);
    check(
      name + ": d, s and + turn and zoom",
      Math.hypot(here[0] - there[0], here[1] - there[1]) > 3 && outline === (await outlineOf(tab)),
    );
    await tab.keyboard.press("0");
    await tab.keyboard.press("Escape");
    check(name + ": Escape leaves the corners", await tab.evaluate(() => document.activeElement === document.body));
    // round the back: a corner that comes into focus is brought to the front
    if (name !== "plane") {
      for (let i = 0; i < 26; i++) await tab.keyboard.press("a");
      await tab.locator("#corners button").first().focus();
      check(name + ": a corner in focus is in front", await tab.evaluate(() => isSeen(cornerAt(0))));
    }
  }
  for (let i = 0; i < 3; i++) await tab.keyboard.press("Delete");
  check(
    "three corners stay",
    (await tab.locator("#corners button").count()) === 3 && (await tab.locator("#remove").isDisabled()),
  );
  await tab.locator("#bars [aria-checked=true]").focus();
  await tab.keyboard.press("ArrowRight");
  check(
    "arrows choose a bar",
    await tab.evaluate(() => document.activeElement.getAttribute("aria-checked") === "true"),
  );
  const nameless = await tab.evaluate(() =>
    [...document.querySelectorAll("button, select, textarea, input, canvas")]
      .filter(
        (e) =>
          !(
            e.getAttribute("aria-label") ||
            e.textContent.trim() ||
            (e.labels && e.labels[0] && e.labels[0].textContent.trim())
          ),
      )
      .map((e) => e.outerHTML),
  );
  check("everything has a name to read aloud", nameless.length === 0, nameless);
  await close(tab, "keys");
}

// --- presets ---------------------------------------------------------------------------------------------------------
{
  const tab = await open();
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await kind(tab, name);
    for (const n of [3, 5, 8, 12]) {
      await tab.selectOption("#sides", String(n));
      const now = await agrees(tab, `regular ${n}-gon, ${name}`);
      const exact = name === "plane" || name === "sphere";
      const rest = Math.max(...Array.from({ length: 12 }, (_, p) => ((p + 1) % n ? now["mu-" + (p + 1)] : 0)));
      check(
        `regular ${n}-gon, ${name}: mu_${n} is 1`,
        exact
          ? Math.abs(now["mu-" + n] - 1) < 1e-12 && rest < 1e-12
          : now["mu-" + n] > 0.75 && now["mu-" + n] > 2 * rest,
        [now["mu-" + n], rest],
      );
      check(
        `regular ${n}-gon, ${name}: it can be seen`,
        await tab.evaluate(() => [...Array(count()).keys()].every((i) => isSeen(cornerAt(i)))),
      );
    }
  }
  await tab.click("[data-preset=octant]");
  check("octant", Math.abs((await agrees(tab, "octant"))["mu-3"] - 1) < 1e-12);
  await tab.click("[data-preset=h3]");
  const h3 = await agrees(tab, "H3 pentagon");
  check("the H3 pentagon is regular", Math.abs(h3["mu-5"] - 1) < 1e-10 && h3["mu-4"] < 1e-10, h3["mu-5"]);
  await tab.click("[data-preset=cell]");
  check("the tissue cell is a hexagon", (await agrees(tab, "tissue cell"))["mu-6"] > 0.95);
  const names = await tab.evaluate(() =>
    [...document.querySelectorAll("#country option")].map((o) => o.value).filter(Boolean),
  );
  check("there are countries", names.length >= 5, names);
  for (const name of names) {
    await tab.selectOption("#country", name);
    const now = await agrees(tab, name);
    check(name + ": curvature is area", Math.abs(now.curvature - now.area) < 1e-12 && now.area > 1e-3);
    const inside = await tab.evaluate(() =>
      [...Array(count()).keys()].every((i) => {
        const [x, y] = toScreen(cornerAt(i));
        return isSeen(cornerAt(i)) && x > 0 && y > 0 && x < width && y < height;
      }),
    );
    check(name + ": all of it can be seen", inside);
  }
  check("the source of the countries is named", /Natural Earth/.test(await tab.textContent("footer")));

  // a line of text, there and back
  await tab.click("[data-preset=cell]");
  const cell = await numbers(tab),
    line = await tab.inputValue("#line");
  await tab.click("[data-preset=octant]");
  await tab.click("#share summary");
  await tab.fill("#line", line);
  await tab.click("#load");
  check("a line of text brings an outline back to the last digit", differ(cell, await numbers(tab)) === 0);
  const kept = await outlineOf(tab);
  for (const bad of [
    "",
    "cube; 1 1 1; 1; 0 0 1, 1 0 0, 0 1 0",
    "sphere; 1 1 1; 1; 0 0 1, 1 0 0",
    "sphere; 1 1 1; 4; 0 0 1, 1 0 0, 0 1 0",
    "sphere; 1 1 1; 1; 0 0 0, 1 0 0, 0 1 0",
    "sphere; 1 1 1; 1; 0 0 x, 1 0 0, 0 1 0",
    "torus; 1 2 0; 1; 1 0 0, 0 1 0, 0 0 1",
    "plane; 1 1 1; 1; 0 0, 1 0, 0 1",
    "plane; 1 1 1; 1; 0 0 0, 1 0 0, 0 1e999 0",
    "plane; 1 1 1; 1",
  ]) {
    await tab.fill("#line", bad);
    await tab.click("#load");
    const said = await tab.textContent("#load-said");
    check(
      `refused with a reason: ${bad}`,
      said.length > 10 && said !== "Loaded." && kept === (await outlineOf(tab)),
      said,
    );
  }
  await close(tab, "presets");
}

// --- what is wrong is said -------------------------------------------------------------------------------------------
{
  const tab = await open();
  const trouble = async (line, sentence, name) => {
    await tab.evaluate((line) => load(line), line);
    await settle(tab);
    const [said, seen, mu] = [
      await tab.textContent("#trouble-text"),
      await tab.isVisible("#trouble"),
      Object.keys(await numbers(tab)),
    ];
    check(name + ": the sentence stands beside the drawing", seen && said.toLowerCase().includes(sentence), said);
    check(name + ": no numbers", mu.length === 0 && (await tab.locator("#bars.none").count()) === 1, mu);
    check(name + ": the table says so", (await tab.inputValue("#tsv")).includes(sentence));
  };
  const clockwise = "the corners run clockwise",
    cross = "the outline crosses itself";
  await trouble("plane; 1 1 1; 1; 0 0 0, 0 1 0, 1 1 0", clockwise, "clockwise, plane");
  await trouble("sphere; 1 1 1; 1; 1 0 0, 0 0 1, 0 1 0", clockwise, "clockwise, sphere");
  await trouble("ellipsoid; 2 1 1; 1; 2 0 0, 0 0 1, 0 1 0", clockwise, "clockwise, ellipsoid");
  await trouble("torus; 1 0.4 0; 1; 1.4 0 0, 1.3 0 0.2, 1.3 0.3 0.2", clockwise, "clockwise, torus");
  await trouble("plane; 1 1 1; 1; 0 0 0, 1 1 0, 1 0 0, 0 1 0", cross, "figure of eight");
  // two loops, one to each side: S and the area are as they should be, but it crosses itself twice
  await trouble("plane; 1 1 1; 1; 0 0 0, 3 0 0, 2 -1 0, 2 4 0, 4 4 0, 1 3 0, 1 2 0, 0 2 0", cross, "two loops");
  await trouble("sphere; 1 1 1; 1; 1 0 0, 1 0.1 0.1, 1 0.1 0, 1 0 0.1", cross, "figure of eight, sphere");
  await trouble("ellipsoid; 2 1 1; 1; 2 0 0, 2 0.1 0.1, 2 0.1 0, 2 0 0.1", cross, "figure of eight, ellipsoid");
  await trouble("torus; 1 0.4 0; 1; 1.4 0 0, 1.4 0.1 0.1, 1.4 0.1 0, 1.4 0 0.1", cross, "figure of eight, torus");
  await trouble("sphere; 1 1 1; 1; 1 0 0, -1 2 0, -1 -2 0", "the enclosed curvature reaches 2 pi", "great circle");
  await trouble("sphere; 1 1 1; 1; 1 0 0, -1 0 0, 0 1 0", "antipodal", "opposite corners");
  await trouble("plane; 1 1 1; 1; 0 0 0, 0 0 0, 0 1 0", "two neighbouring corners coincide", "the same corner twice");
  const ring = Array.from(
    { length: 9 },
    (_, i) => `${1.4 * Math.cos((i * Math.PI) / 4.5)} ${1.4 * Math.sin((i * Math.PI) / 4.5)} 0`,
  );
  await trouble("torus; 1 0.4 0; 1; " + ring.join(", "), "winds round the torus", "round the axis");
  await trouble("torus; 1 0.4 0; 1; 1.4 0 0, 0.8 0 0.346, 0.8 0 -0.346", "winds round the torus", "round the tube");
  await tab.click("[data-preset=octant]");
  check("and it goes when it is mended", !(await tab.isVisible("#trouble")));
  await tab.click("#turn");
  check("turned round: clockwise", (await tab.textContent("#trouble-text")).toLowerCase().includes(clockwise));
  await tab.click("#turn");
  check("and back", Math.abs((await agrees(tab, "turned twice"))["mu-3"] - 1) < 1e-12);
  await close(tab, "trouble");
}

// --- fingers, on a telephone -----------------------------------------------------------------------------------------
{
  const tab = await open({
    viewport: { width: 360, height: 740 },
    deviceScaleFactor: 2,
    hasTouch: true,
    isMobile: true,
  });
  const session = await tab.context().newCDPSession(tab);
  const touch = (type, ...points) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await tab.tap(`#kinds label:has([value=${name}])`);
    if (name === "sphere") await tab.tap("[data-preset=regular]");
    await tab.locator("#stage").scrollIntoViewIfNeeded();
    const before = await agrees(tab, name + ", telephone");
    const [x, y] = await cornerPlace(tab, 2);
    await touch("touchStart", [x + 12, y + 9]); // a finger is wide: beside the corner will do
    for (let i = 1; i <= 5; i++) await touch("touchMove", [x + 12 + 4 * i, y + 9 + 4 * i]);
    await touch("touchEnd");
    const after = await agrees(tab, name + ", dragged by a finger"),
      [u, v] = await cornerPlace(tab, 2);
    check(name + ": a finger drags a corner", differ(before, after) > 1e-3 && Math.hypot(u - x - 20, v - y - 20) < 2, [
      u - x,
      v - y,
    ]);
    check(
      name + ": the page does not scroll meanwhile",
      await tab.evaluate(() => document.documentElement.scrollWidth <= 360),
    );

    const count = await tab.locator("#corners button").count();
    await touch("touchStart", [u, v]);
    await tab.waitForTimeout(700);
    await touch("touchEnd");
    check(name + ": a long press removes a corner", (await tab.locator("#corners button").count()) === count - 1);
    await tab.tap("#undo");
    const stage = await tab.locator("#stage").boundingBox(),
      scale = await tab.evaluate(() => view.scale);
    const [cx, cy] = [stage.x + stage.width / 2, stage.y + stage.height - 30];
    await touch("touchStart", [cx - 30, cy], [cx + 30, cy]);
    for (let i = 1; i <= 4; i++) await touch("touchMove", [cx - 30 - 8 * i, cy], [cx + 30 + 8 * i, cy]);
    await touch("touchEnd");
    check(name + ": two fingers zoom", (await tab.evaluate(() => view.scale)) > 1.3 * scale);
    await tab.tap("#fit");
    const place = await tab.evaluate(() => {
      const e = (outline.base + 2) % count(),
        all = [...found.edgeOf.keys()].filter((i) => found.edgeOf[i] === e);
      const i = all[all.length >> 1],
        box = stage.getBoundingClientRect();
      const [x, y] = toScreen(times(plus(at(found.point, i), at(found.point, (i + 1) % found.edgeOf.length)), 0.5));
      return [box.x + 1 + x, box.y + 1 + y];
    });
    for (let i = 0; i < 2; i++) {
      await touch("touchStart", place);
      await touch("touchEnd");
    }
    check(
      name + ": a double tap on a line adds a corner",
      (await tab.locator("#corners button").count()) === count + 1,
    );
    await agrees(tab, name + ", telephone, added");
  }
  for (const summary of await tab.locator("summary").all()) await summary.tap();
  for (const width of [360, 320, 768]) {
    await tab.setViewportSize({ width, height: 740 });
    await settle(tab);
    const wide = await tab.evaluate(() => document.documentElement.scrollWidth);
    check(`${width} pixels: nothing to scroll sideways`, wide <= width, wide);
  }
  const small = await tab.evaluate(() =>
    [...document.querySelectorAll("button:not(#corners button, .bars button, .step), select")]
      .filter((e) => e.getBoundingClientRect().height < 40)
      .map((e) => e.id || e.textContent),
  );
  check("buttons are as tall as a finger is wide", small.length === 0, small);
  await close(tab, "telephone");
}

// --- light, dark, and what moves -------------------------------------------------------------------------------------
const contrast = (tab) =>
  tab.evaluate(() => {
    const light = (text) => {
      const [r, g, b] = text
        .match(/[\d.]+/g)
        .map((c) => c / 255)
        .map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const behind = (e) => {
      for (; e; e = e.parentElement)
        if (!/, 0\)|transparent/.test(getComputedStyle(e).backgroundColor)) return getComputedStyle(e).backgroundColor;
      return "rgb(255, 255, 255)";
    };
    let least = 99,
      where = "";
    for (const e of document.querySelectorAll(
      "h1, h2, p, b, summary, button:not(:disabled):not(.behind), select, th, td, .legend, .under, .name, .rank, code",
    )) {
      if (!e.getClientRects().length || !e.textContent.trim()) continue;
      const [a, b] = [light(getComputedStyle(e).color), light(behind(e))].sort((a, b) => b - a);
      if ((a + 0.05) / (b + 0.05) < least) [least, where] = [(a + 0.05) / (b + 0.05), e.outerHTML.slice(0, 80)];
    }
    return [least, where];
  });
{
  const seen = {};
  for (const colorScheme of ["light", "dark"]) {
    const tab = await open({ colorScheme });
    seen[colorScheme] = await tab.evaluate(() => {
      // the page, and a column of the drawing
      const column = front.getImageData(canvas.width >> 1, 0, 1, canvas.height).data;
      return (
        getComputedStyle(document.body).backgroundColor + " " + column.reduce((sum, x) => sum + x, 0) / column.length
      );
    });
    const [least, where] = await contrast(tab);
    check(colorScheme + ": text has a contrast of 4.5 at least", least >= 4.5, [least, where]);
    await tab.emulateMedia({ colorScheme: colorScheme === "light" ? "dark" : "light" });
    await settle(tab);
    check(colorScheme + ": it follows a change of mind", (await contrast(tab))[0] >= 4.5);
    await close(tab, colorScheme);
  }
  check("dark is another picture", seen.light !== seen.dark, seen);

  const still = await open();
  await still.click("[data-preset=h3]");
  const at = await cornerPlace(still, 0);
  await still.waitForTimeout(500);
  check("nothing moves by itself for those who do not want it", (await cornerPlace(still, 0)).join() === at.join());
  await close(still, "still");
  const moving = await open({ reducedMotion: "no-preference" });
  await moving.click("[data-preset=h3]");
  await moving.waitForTimeout(700);
  check(
    "and for others it comes to the same view",
    Math.hypot(...(await cornerPlace(moving, 0)).map((x, k) => x - at[k])) < 1,
  );
  await agrees(moving, "moving");
  await close(moving, "moving");
}

await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
