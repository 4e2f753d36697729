// playground_page.mjs PAGE SURFMINK MODULES [PART]: docs/playground.html in headless Chromium, driven by playwright-core,
// which npm has put into MODULES. With hands: mouse, keys, fingers. After each the page's numbers must be those of the
// command SURFMINK for the table that the page hands out, to 1e-12.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [page, surfmink, modules, part = ""] = process.argv.slice(2);
const wanted = (name) => name.includes(part); // all, or those parts whose name has PART in it
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
async function open(options = {}, fragment = "") {
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
    const url = request.url().split("#")[0];
    if (url !== address && !url.startsWith("data:")) tab.asked.push(request.url());
  });
  await tab.goto(address + (fragment ? "#" + fragment : ""));
  await until(tab, () => document.getElementById("mu-1") !== null);
  return tab;
}

// A tap and its click, which browsers send later, and what the page then draws. The page scrolls there first and comes
// to rest: a tap that stops a moving page is no click.
async function tap(target) {
  const tab = target.page();
  await target.scrollIntoViewIfNeeded();
  await tab.waitForTimeout(300);
  const clicked = tab.evaluate(
    () =>
      new Promise((drawn) => {
        setTimeout(drawn, 3000); // there was none: what follows fails
        addEventListener("click", () => requestAnimationFrame(() => requestAnimationFrame(drawn)), { once: true });
      }),
  );
  await target.tap();
  await clicked;
  await settle(tab);
}

// A tab on a telephone, and what fingers do there: touch("touchStart", [x, y], ...).
async function openTelephone(viewport) {
  const tab = await open({ viewport, deviceScaleFactor: 2, hasTouch: true, isMobile: true });
  const session = await tab.context().newCDPSession(tab);
  const touch = (type, ...points) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  return { tab, touch };
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

// What the verdict has to say, by a rule of its own: the rank with the largest mu that such an outline can have, and a
// word for that mu. Classical transport shows n corners that turn by S as n 2 pi / S of them.
function rightVerdict(mu, corners) {
  const names = { 3: ["triangle", "triangular"], 4: ["square", "square"], 5: ["pentagon", "pentagonal"] };
  names[6] = ["hexagon", "hexagonal"];
  for (let p = 7; p <= 12; p++) names[p] = [`${p}-gon`, `${p}-fold`];
  const ranks = [2, 3, 4, 5, 6];
  for (let p = 7; p <= Math.min(12, Math.ceil(corners - 1e-9)); p++) if (mu[p] > 0.5) ranks.push(p);
  const top = Math.max(...ranks.map((p) => mu[p])),
    p = ranks.find((p) => mu[p] > top - 0.0051),
    x = mu[p];
  const a = (name) => (/^(8|11)/.test(name) ? "an " : "a ") + name;
  const long = p > 2 && mu[2] >= 0.15 && x >= 0.15;
  let said;
  if (x < 0.15) said = "nearly round";
  else if (p === 2) said = x < 0.35 ? "slightly elongated" : x < 0.7 ? "elongated" : "very elongated";
  else if (x < 0.35) said = "slightly " + names[p][1];
  else if (x < 0.7) said = "somewhat " + names[p][1];
  else said = (x < 0.9 ? "almost " : "") + (p === 4 && long ? "a rectangle" : a(names[p][0]));
  return {
    said,
    mu: x,
    value: ` (mu${p} = ${x.toFixed(2)})`,
    also: long ? `, elongated (mu2 = ${mu[2].toFixed(2)})` : "",
  };
}

// Is the verdict that of the numbers, for both transports? Returns what it says.
async function verdictIs(tab, name, wanted = "") {
  const now = await numbers(tab);
  const [said, corners] = await tab.evaluate(() => [document.getElementById("verdict").textContent, count()]);
  const list = (prefix) => Array.from({ length: 13 }, (_, p) => (p ? now[prefix + p] : 0));
  const one = rightVerdict(list("mu-"), corners),
    other = rightVerdict(list("classical-"), (corners * 2 * Math.PI) / now.turning);
  const same = one.said === other.said && Math.abs(one.mu - other.mu) < 0.01;
  const right =
    `This outline is ${one.said}${one.value}${one.also}. ` +
    `Classical transport says: ${same ? "the same" : other.said + other.value}.`;
  check(name + ": the verdict", said === right, [said, right]);
  if (wanted) check(`${name}: the verdict says ${wanted}`, said.startsWith(`This outline is ${wanted} (`), said);
  return said;
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
if (wanted("mouse")) {
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
if (wanted("keys")) {
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
if (wanted("presets")) {
  const tab = await open();
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await kind(tab, name);
    for (let n = 3; n <= 12; n++) {
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
      const word = { 3: "a triangle", 4: "a square", 5: "a pentagon", 6: "a hexagon", 8: "an 8-gon", 11: "an 11-gon" }[
        n
      ];
      const clear = now["mu-" + n] >= 0.9;
      await verdictIs(tab, `regular ${n}-gon, ${name}`, (clear ? "" : "almost ") + (word || `a ${n}-gon`));
      check(
        `regular ${n}-gon, ${name}: it can be seen`,
        await tab.evaluate(() => [...Array(count()).keys()].every((i) => isSeen(cornerAt(i)))),
      );
    }
  }
  await tab.click("[data-preset=octant]");
  check("octant", Math.abs((await agrees(tab, "octant"))["mu-3"] - 1) < 1e-12);
  const octant = await verdictIs(tab, "octant", "a triangle");
  check("octant: classically a square", octant.endsWith("says: a square (mu4 = 1.00)."), octant);
  await tab.click("[data-preset=h3]");
  const h3 = await agrees(tab, "H3 pentagon");
  check("the H3 pentagon is regular", Math.abs(h3["mu-5"] - 1) < 1e-10 && h3["mu-4"] < 1e-10, h3["mu-5"]);
  await verdictIs(tab, "H3 pentagon", "a pentagon");
  await tab.click("[data-preset=cell]");
  check("the tissue cell is a hexagon", (await agrees(tab, "tissue cell"))["mu-6"] > 0.95);
  await verdictIs(tab, "tissue cell", "a hexagon");
  const names = await tab.evaluate(() =>
    [...document.querySelectorAll("#country option")].map((o) => o.value).filter(Boolean),
  );
  check("there are countries", names.length >= 5, names);
  for (const name of names) {
    await tab.selectOption("#country", name);
    const now = await agrees(tab, name);
    await verdictIs(tab, name);
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

  // other outlines with a verdict to get right
  const round = (n) =>
    Array.from({ length: n }, (_, i) => [Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n)]);
  const plane = (points) => "plane/1/" + points.map((x) => x.map((c) => c.toFixed(12)).join()).join("/");
  const extra = round(12); // a 12-gon with a thirteenth corner in the middle of an edge
  extra.splice(1, 0, [(extra[0][0] + extra[1][0]) / 2, (extra[0][1] + extra[1][1]) / 2]);
  for (const [name, points, wanted] of [
    ["a 12-gon with a corner more", extra, "a 12-gon"],
    ["a circle", round(100), "nearly round"],
    [
      "a rectangle",
      [
        [0, 0],
        [3, 0],
        [3, 1],
        [0, 1],
      ],
      "a rectangle",
    ],
    [
      "a needle",
      [
        [0, 0],
        [300, 0],
        [150, 1],
      ],
      "very elongated",
    ],
    ["an ellipse", round(100).map(([x, y]) => [2 * x, y]), "elongated"],
    [
      "the triangle 3 4 5",
      [
        [0, 0],
        [4, 0],
        [0, 3],
      ],
      "almost a triangle",
    ],
  ]) {
    check(name + ": is shown", (await tab.evaluate((text) => showShape(text), plane(points))) === "");
    await verdictIs(tab, name, wanted);
  }
  await close(tab, "presets");
}

// --- an outline in an address ----------------------------------------------------------------------------------------
const fragmentOf = (tab) => new URL(tab.url()).hash.slice(1);
if (wanted("address")) {
  const tab = await open();
  check("as it opens the address is that of the page", tab.url() === address, tab.url());
  await tab.evaluate(() => load("x,y,z,nx,ny,nz\n1,0,0,1,0,.1\n0,1,0,0,1,0\n0,0,1.5,0,0,1\n")); // a fifth kind
  for (const name of ["plane", "sphere", "ellipsoid", "torus", "embedded"]) {
    await kind(tab, name);
    await tab.click("#base-more");
    const here = await numbers(tab),
      text = await fragmentOf(tab),
      drawn = await outlineOf(tab);
    check(name + ": the address follows", text.startsWith(name + "/"), text);
    check(name + ": as a link", (await tab.inputValue("#link")) === tab.url(), tab.url());
    const there = await open({}, text);
    check(name + ": the address brings the outline back to the last digit", (await outlineOf(there)) === drawn);
    check(name + ": and its numbers", differ(here, await agrees(there, name + ", from an address")) === 0);
    check(name + ": and is kept", (await fragmentOf(there)) === text);
    // commas as mail programs write them, and the whole link through the window
    const mailed = await open({}, text.replaceAll(",", "%2C"));
    check(name + ": %2C is a comma", (await outlineOf(mailed)) === drawn);
    await mailed.click("[data-preset=octant]");
    await mailed.click("#open-load");
    await mailed.fill("#load-text", "  " + tab.url() + "\n");
    await mailed.click("#load-do");
    check(name + ": a link can be loaded", (await outlineOf(mailed)) === drawn && !(await mailed.isVisible("#load")));
    await close(mailed, name + ", mailed");
    await close(there, name + ", from an address");
  }
  // an address typed into the page that is open
  const text = "plane/2/0,0/4,0/4,3";
  await tab.evaluate((text) => document.defaultView.location.replace("#" + text), text);
  await until(tab, () => outline.kind === "plane" && count() === 3);
  check("an address that changes is read", Math.abs((await agrees(tab, "3 4 5"))["mu-2"] - 0.4472135955) < 1e-9);
  await close(tab, "address");

  const points = (n) => Array.from({ length: n }, (_, i) => `${i},${i * i}`).join("/");
  const hostile = {
    "another kind": "cube/1/0,0/1,0/0,1",
    "a name that every object has": "constructor/1/0,0/1,0/0,1",
    "and another": "__proto__/1/0,0/1,0/0,1",
    markup: "plane/1/<img src=x onerror=alert(1)>/1,0/0,1",
    "markup, encoded": "%3Cscript%3Ealert(1)%3C%2Fscript%3E",
    "markup for a kind": '"><svg onload=alert(1)>/1/0,0/1,0/0,1',
    script: "javascript:alert(1)",
    "an infinity": "plane/1/0,0/1e999,0/0,1",
    "an infinity by name": "plane/1/0,0/Infinity,0/0,1",
    "no number": "plane/1/0,0/NaN,0/0,1",
    "a number of programs": "plane/1/0,0/0x10,0/0,1",
    "an empty number": "plane/1/0,0/,0/0,1",
    "too large a number": "plane/1/0,0/9999999999,0/0,1",
    "too many digits": `plane/1/0,0/${"1".repeat(400)},0/0,1`,
    blanks: "plane/1/0,0/1 ,0/0,1",
    "one number too many": "plane/1/0,0,0/1,0,0/0,1,0",
    "one number too few": "sphere/1/0,0/1,0/0,1",
    "two corners": "plane/1/0,0/1,0",
    "no corner": "plane/1",
    nothing: "plane",
    "edge 0": "plane/0/0,0/1,0/0,1",
    "edge 4": "plane/4/0,0/1,0/0,1",
    "edge 1.5": "plane/1.5/0,0/1,0/0,1",
    "a corner at the middle of the sphere": "sphere/1/0,0,0/1,0,0/0,1,0",
    "a torus without a hole": "torus/1,2/1/3,0,0/0,3,0/0,0,2",
    "a flat ellipsoid": "ellipsoid/1,1,0/1/1,0,0/0,1,0/0,0,1",
    "a shape of two numbers": "ellipsoid/1,1/1/1,0,0/0,1,0/0,0,1",
    "1,025 corners": "plane/1/" + points(1025),
    "129 corners on a torus": "torus/1,0.4/1/" + Array(129).fill("1.4,0,0").join("/"),
    "a megabyte": "plane/1/" + "0,0/".repeat(250000),
    "a bad code": "plane/1/0,0/%E0%A4%A/1,0",
  };
  const one = await open();
  let alarmed = false;
  one.on("dialog", (dialog) => {
    alarmed = true;
    dialog.dismiss();
  });
  const octant = await outlineOf(one),
    shown = await one.evaluate(() => document.querySelectorAll("*").length);
  const refuses = async (tab, name) => {
    await settle(tab);
    const said = await tab.textContent("#notice");
    check(`hostile, ${name}: refused`, (await outlineOf(tab)) === octant);
    check(
      `hostile, ${name}: with a sentence`,
      (await tab.isVisible("#notice")) && /^(The|A) .*link.* The outline here is another one\.$/.test(said),
      said,
    );
    const [size, html] = await tab.evaluate(() => [
      document.querySelectorAll("*").length,
      document.body.innerHTML + document.getElementById("link").value,
    ]);
    const text = html.replace(/<script[^]*?<\/script>/g, "");
    check(
      `hostile, ${name}: nothing of it reaches the page`,
      size === shown && !alarmed && !/alert\(1\)|onerror|1111111|0x10|cube|__proto__/.test(text),
      size - shown,
    );
  };
  for (const [name, text] of Object.entries(hostile)) {
    await one.evaluate((text) => {
      notify("");
      document.defaultView.location.replace("#" + text);
    }, text);
    for (let i = 0; i < 100 && (await one.textContent("#notice")) === ""; i++) await one.waitForTimeout(20);
    await refuses(one, name);
  }
  await close(one, "hostile");
  for (const name of ["markup", "an infinity", "too many digits"]) {
    const tab = await open({}, hostile[name]);
    await refuses(tab, name + ", as it opens");
    await close(tab, name);
  }
  const anchor = await open({}, "numbers"); // a place of the page is no outline
  check(
    "#numbers is a place of the page",
    !(await anchor.isVisible("#notice")) && (await outlineOf(anchor)) === octant,
  );
  await close(anchor, "#numbers");
}

// --- a table that is pasted --------------------------------------------------------------------------------------------
if (wanted("table")) {
  const tab = await open();
  await tab.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  // As Ctrl+V does, beside any window.
  const paste = (text) =>
    tab.evaluate((text) => {
      const clipboardData = new DataTransfer();
      clipboardData.setData("text/plain", text);
      document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
    }, text);
  const choose = (surface) =>
    tab.evaluate((surface) => {
      document.getElementById("load-surface").value = surface;
    }, surface);
  // All outlines of a table, held against the command on the same table.
  const holds = async (name, text, options = [], surface = "", most = 12) => {
    await choose(surface);
    await paste(text);
    const open = await tab.isVisible("#load");
    check(name + ": is read", !open, open && (await tab.textContent("#load-why")));
    if (open) return tab.click("#load [data-close]");
    let said;
    try {
      const words = ["--quiet", "--max-rank", "12", "--digits", "17", ...options];
      said = execFileSync(surfmink, words, { input: text, encoding: "utf8" });
    } catch (error) {
      said = error.status === 2 ? error.stdout : "";
    }
    const [head, ...rows] = said
      .trimEnd()
      .split("\n")
      .map((row) => row.split("\t"));
    const ids = await tab.evaluate(() => loaded.map(({ id }) => id));
    check(
      name + ": as many outlines, of the same id",
      ids.join() === rows.map((row) => row[head.indexOf("id")]).join(),
      ids.slice(0, 5),
    );
    for (const [i, row] of rows.slice(0, most).entries()) {
      if (rows.length > 1) await tab.selectOption("#which", String(i));
      const value = (key) => row[head.indexOf(key)],
        f = await tab.evaluate(() => ({ name: found.name, mu: [...found.mu], n: count() }));
      const worst = Math.max(...f.mu.slice(1).map((mu, p) => Math.abs(mu - Number(value("mu_" + (p + 1))))));
      check(
        `${name}, ${row[0]}: what the command says`,
        f.name === value("status") && f.n === Number(value("n")) && (f.name !== "ok" || worst < 1e-11),
        [f.name, f.n, worst, value("status")],
      );
      if (f.name === "ok") await agrees(tab, `${name}, ${row[0]}`);
    }
  };
  const file = (name) => readFileSync(new URL("../../examples/data/" + name, import.meta.url), "utf8");
  await holds("tissue.tsv", file("tissue.tsv"));
  check("a table with normals is a surface of its own", await tab.isVisible("#kinds [value=embedded] + span"));
  await holds("h3_res2.tsv", file("h3_res2.tsv").split("\n").slice(0, 200).join("\n") + "\n");
  await holds("countries.tsv", file("countries.tsv"));
  await holds("the plane", "x,y\n0,0\n4,0\n4,2\n0,2\n");
  await holds("far away and small", "x,y\n1000000,2000000\n1000000.25,2000000\n1000000.25,2000000.125\n");
  await holds("units, capitals, quotes, semicolons, decimal commas", '"X (um)";"Y [um]"\n0,5;0\n4;0,25\n"4,5";2\n');
  await holds("blanks and Windows", "  x   y\r\n 0   0\r\n 4   0\r\n 4   2.5\r\n");
  await holds("old Macs, a mark at the beginning", "\ufeffx\ty\r0\t0\r4\t0\r4\t2\r");
  await holds("rows and columns of an image", "label,row,col\n7,0,0\n7,5,0\n7,5,9\n8,10,10\n8,10,12\n8,7,11\n");
  await holds("clockwise", "x y\n0 0\n0 3\n4 0\n");
  await holds("clockwise, sphere", "lon lat\n0 0\n0 30\n40 0\n");
  await holds("the first corner again", "x y\n0 0\n4 0\n4 3\n0 0\n");
  await holds("no names: a line an outline", "0,0,4,0,4,3\n0,0,1,0,1,1,0,1\n");
  await holds("blank lines, and > of GMT", "# a comment\nlon,lat\n0,0\n30,0\n0,30\n\n> next\n0,0\n40,0\n40,20\n");
  await holds("NaN between outlines", "x,y\n0,0\n4,0\n4,3\nNaN,NaN\n0,0\n1,0\n1,1\n0,1\n");
  await holds(
    "ids of two columns, others beside",
    "frame,cell_id,x,y,area\n1,a,0,0,7\n1,a,4,0,7\n1,a,4,3,7\n2,a,0,0,7\n2,a,1,0,7\n2,a,0,1,7\n",
  );
  await holds("corners in the order of k", "k x y\n3 4 3\n1 0 0\n2 4 0\n");
  await holds("row names of R", '"x" "y"\n"1" 0 0\n"2" 4 0\n"3" 4 3\n');
  await holds("an index without a name", ",x,y\n0,0,0\n1,4,0\n2,4,3\n");
  await holds("an id without a name", ",x,y\na,0,0\na,4,0\na,4,3\nb,0,0\nb,1,0\nb,0,1\n");
  await holds("x y z on a sphere", "x,y,z\n2,0,0\n0,2,0\n0,0,2\n", ["--surface", "sphere"], "sphere");
  await holds("x y z seen from above", "x,y,z\n2,0,5\n0,2,1\n0,0,2\n", ["--surface", "plane"], "plane");
  await holds("one that crosses itself", "x,y\n0,0\n4,4\n4,0\n0,3\n");
  await holds(
    "a thousand corners",
    "x,y\n" +
      Array.from({ length: 1000 }, (_, i) => [2 * Math.cos(i / 159.2), Math.sin(i / 159.2)].join()).join("\n") +
      "\n",
  );

  // what cannot be read, with an example that can
  const kept = await outlineOf(tab);
  for (const [name, text, reason, surface] of [
    ["nothing", "# only a comment\n", "no line that names the columns"],
    ["no names", "1 2\n3 4\n5 6\n", "Line 1: this line should name the columns"],
    ["a word for a number", "x,y\n0,0\n4,zero\n4,2\n", "Line 3: 'zero' in column 'y' is not a number"],
    ["an empty field", "x,y\n0,0\n4,\n4,2\n", "Line 3: column 'y' is empty"],
    ["a field too few", "x,y\n0,0\n4\n4,2\n", "Line 3: no field for column 'y'"],
    ["a field too many", "x,y\n0,0\n4,1,7\n4,2\n", "Line 3: 3 fields, but 2 columns are named"],
    ["no y", "x,width\n0,0\n", "no column 'y'"],
    ["no normals", "x,y,z\n1,0,0\n0,1,0\n0,0,1\n", "columns nx ny nz are missing"],
    ["lon lat and x y", "lon,lat,x,y\n0,0,0,0\n", "choose the surface"],
    ["two x", "x,y,X\n0,0,0\n", "two columns are named 'x'"],
    ["no corners", "x,y\n", "no corners"],
    ["a latitude of 100", "lon,lat\n0,0\n10,100\n20,0\n", "Line 3: a latitude is not between -90 and 90"],
    ["an infinity", "x,y\n0,0\n4,inf\n4,2\n", "Line 3: a number is not finite"],
    ["the same k twice", "k,x,y\n1,0,0\n1,4,0\n2,4,2\n", "k is not whole"],
    ["two rings", "x,y\n0,0\n4,0\n4,4\n0,0\n1,1\n2,1\n", "the first corner comes again"],
    ["a comma, then a point", "x\ty\n0,5\t0\n4.5\t0\n1\t2\n", "decimal point"],
    ["an open quote", 'x,y\n0,"0\n', "a quote is not closed"],
    ["a zero byte", "x,y\n0,\0\n", "a zero byte"],
    ["GeoJSON", '{"type": "FeatureCollection"}', "JSON"],
    ["a mesh", "OFF\n3 1 0\n", "mesh"],
    [
      "1,025 corners",
      "x,y\n" + Array.from({ length: 1025 }, (_, i) => `${Math.cos(i / 164)},${Math.sin(i / 164)}`).join("\n"),
      "1025 corners",
    ],
    ["markup", "<img src=x onerror=alert(1)>\n", "Line 1"],
    ["a table too long", null, "longer than 8 MB"],
  ]) {
    await choose(surface || "");
    if (text === null) await tab.evaluate(() => load("x,y\n" + "0,0\n".repeat(1 << 21) + "1,1\n"));
    else await paste(text);
    const why = await tab.textContent("#load-why");
    check(`${name}: said`, (await tab.isVisible("#load-why")) && why.includes(reason), why);
    const example = await tab.textContent("#load-right");
    check(`${name}: with an example`, (await tab.isVisible("#load-right")) && example.split("\n").length >= 4, example);
    check(`${name}: the outline stays`, (await outlineOf(tab)) === kept);
    check(`${name}: as text`, (await tab.locator("#load img").count()) === 0);
    // the example itself can be read
    if (!(await tab.isVisible("#load"))) await tab.click("#open-load");
    await choose("");
    await tab.fill("#load-text", example);
    await tab.click("#load-do");
    check(`${name}: the example can be read`, !(await tab.isVisible("#load")), example);
    if (await tab.isVisible("#load")) await tab.click("#load [data-close]");
    await tab.click("#undo");
  }
  // one bad outline among good ones
  await paste("cell,x,y\na,0,0\na,inf,0\na,4,2\nb,0,0\nb,4,0\nb,4,3\n");
  check(
    "a bad outline: the next is shown",
    (await tab.inputValue("#which")) === "1" && (await tab.evaluate(() => found.ok)),
  );
  await tab.selectOption("#which", "0");
  check(
    "a bad outline: chosen, it is named",
    /Line 3/.test(await tab.textContent("#notice")),
    await tab.textContent("#notice"),
  );

  // by hand, through the window
  await tab.click("#open-load");
  await tab.click("#load-example");
  await tab.click("#load-do");
  await verdictIs(tab, "the example of the window", "a rectangle");
  await tab.evaluate(() => navigator.clipboard.writeText("x y\n0 0\n1 0\n1 1\n0 1\n"));
  await tab.keyboard.press("Control+v");
  await until(tab, () => Math.abs(found.length - 4) < 1e-12);
  await verdictIs(tab, "Ctrl+V", "a square");
  await tab.click("#open-load");
  await tab.keyboard.press("Control+v");
  check("in the window Ctrl+V fills the field", (await tab.inputValue("#load-text")).includes("1 1"));
  await tab.click("#load [data-close]");
  await tab.evaluate(() => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(["x,y\n0,0\n6,0\n6,2\n0,2\n"], "cells.csv"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  });
  await until(tab, () => Math.abs(found.length - 16) < 1e-12);
  await verdictIs(tab, "a file that is dropped", "a rectangle");

  // on a surface of its own, by hand
  await paste(file("tissue.tsv"));
  let before = await agrees(tab, "a cell");
  const [x, y] = await cornerPlace(tab, 1);
  await tab.mouse.move(x, y);
  await tab.mouse.down();
  await tab.mouse.move(x + 15, y - 12, { steps: 3 });
  await tab.mouse.up();
  const [u, v] = await cornerPlace(tab, 1);
  check("table: a corner is dragged", Math.hypot(u - x - 15, v - y + 12) < 1.5, [u - x, v - y]);
  check(
    "table: in its tangent plane",
    await tab.evaluate(() => {
      const old = past[past.length - 1];
      return Math.abs(dot(plus(cornerAt(1), at(old.corners, 1), -1), unit(cornerNormal(1)))) < 1e-9 * extentOf().reach;
    }),
  );
  check("table: values change", differ(before, await agrees(tab, "a cell, dragged")) > 1e-3);
  const n = await tab.evaluate(() => count());
  await tab.click("#add");
  await agrees(tab, "a cell, a corner added");
  await tab.click("#remove");
  check(
    "table: added and removed",
    (await tab.evaluate(() => count() * 3 === outline.normals.length && count())) === n,
  );
  await tab.click("#turn");
  await tab.click("#turn");
  await agrees(tab, "a cell, reversed twice");
  await close(tab, "tables");
}

// --- handles of outlines with many corners -------------------------------------------------------------------------------
if (wanted("handles")) {
  const apart = (tab) =>
    tab.evaluate(() => {
      const places = [...$("corners").children].map((b, i) =>
        b.hidden ? null : [...toScreen(cornerAt(i)), isCornerSeen(i)],
      );
      let least = Infinity,
        shown = 0;
      for (let i = 0; i < places.length; i++)
        if (places[i] && i !== selected) {
          shown++;
          for (let j = 0; j < i; j++)
            if (places[j] && j !== selected && places[i][2] === places[j][2])
              least = Math.min(least, Math.hypot(places[i][0] - places[j][0], places[i][1] - places[j][1]));
        }
      return [least, shown, count()];
    });
  for (const hasTouch of [false, true]) {
    const tab = await open(hasTouch ? { viewport: { width: 390, height: 844 }, hasTouch, isMobile: true } : {});
    const name = hasTouch ? "a finger" : "a mouse",
      room = hasTouch ? 30 : 22;
    await tab.selectOption("#country", "Chile");
    const [least, shown, all] = await apart(tab);
    check(`${name}: handles stand apart`, least >= room && shown >= 5 && shown < all, [least, shown, all]);
    for (let i = 0; i < 6; i++) await tab.click("#closer");
    const closer = await apart(tab);
    check(`${name}: closer there are more`, closer[0] >= room && closer[1] > shown, closer);
    await tab.selectOption("#sides", "12");
    check(`${name}: of 12 corners all have handles`, (await apart(tab))[1] >= 11, await apart(tab));
    await close(tab, "handles for " + name);
  }
  const tab = await open();
  await tab.selectOption("#country", "Chile");
  await tab.locator("#corners button:not([hidden])").first().focus();
  const label = () => tab.evaluate(() => document.activeElement.getAttribute("aria-label"));
  check("the first corner is in focus", /^Corner 1 of 92/.test(await label()), await label());
  await tab.keyboard.press("PageDown");
  check("Page Down: the second, which had no handle", /^Corner 2 of 92/.test(await label()), await label());
  await tab.keyboard.press("PageUp");
  await tab.keyboard.press("PageUp");
  check("Page Up: the last", /^Corner 92 of 92/.test(await label()), await label());
  const before = await numbers(tab);
  await tab.keyboard.press("ArrowLeft");
  check("and it can be moved", differ(before, await agrees(tab, "a corner without a handle")) > 1e-6);
  await close(tab, "handles");
}

// --- help ------------------------------------------------------------------------------------------------------------
if (wanted("help")) {
  const tab = await open();
  await tab.click("#add"); // something to undo
  await tab.keyboard.press("?");
  check("? opens the help", await tab.isVisible("#help"));
  const text = await tab.textContent("#help");
  for (const key of [
    "Tab",
    "Shift",
    "Page Down",
    "Page Up",
    "Insert",
    "Delete",
    "W",
    "A",
    "S",
    "D",
    "+",
    "0",
    "Ctrl",
    "?",
    "Esc",
  ])
    check(`help: it names ${key}`, text.includes(key));
  const drawn = () => tab.evaluate(() => JSON.stringify([outline, view]));
  const before = await drawn();
  await tab.keyboard.press("d");
  await tab.keyboard.press("Control+z");
  check("help: keys do nothing behind it", before === (await drawn()));
  await tab.keyboard.press("Escape");
  check("Esc closes it", !(await tab.isVisible("#help")));
  await tab.click("#open-help");
  check("its button opens it", await tab.isVisible("#help"));
  await tab.click("#help [data-close]");
  check("and a button closes it", !(await tab.isVisible("#help")));
  await tab.locator("#corners button").first().focus();
  await tab.keyboard.press("n");
  check("N adds a corner", (await tab.evaluate(() => count())) === 5);
  await tab.click("#open-load");
  check("the window for tables has the focus", await tab.evaluate(() => document.activeElement.id === "load-text"));
  await tab.keyboard.press("?");
  check(
    "? in a field is a question mark",
    (await tab.inputValue("#load-text")) === "?" && !(await tab.isVisible("#help")),
  );
  await tab.keyboard.press("Escape");
  check("Esc closes the window for tables", !(await tab.isVisible("#load")));
  await close(tab, "help");
}

// --- what is wrong is said -------------------------------------------------------------------------------------------
if (wanted("trouble")) {
  const tab = await open();
  const trouble = async (line, sentence, name) => {
    const [kind, shape, base, points] = line.split("; ");
    const parts = [kind, ...({ ellipsoid: [shape], torus: [shape.replace(/ 0$/, "")] }[kind] || []), base];
    for (const x of points.split(", ")) parts.push(kind === "plane" ? x.replace(/ 0$/, "") : x);
    const wrong = await tab.evaluate((text) => showShape(text), parts.join("/").replaceAll(" ", ","));
    check(name + ": is shown", wrong === "", wrong);
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
    (_, i) => [Math.cos, Math.sin].map((f) => (1.4 * f((i * Math.PI) / 4.5)).toFixed(9)).join(" ") + " 0",
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
if (wanted("fingers")) {
  const { tab, touch } = await openTelephone({ width: 360, height: 740 });
  for (const name of ["plane", "sphere", "ellipsoid", "torus"]) {
    await tap(tab.locator(`#kinds label:has([value=${name}])`));
    if (name === "sphere") await tap(tab.locator("[data-preset=regular]"));
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
    await tap(tab.locator("#undo"));
    const stage = await tab.locator("#stage").boundingBox(),
      scale = await tab.evaluate(() => view.scale);
    const [cx, cy] = [stage.x + stage.width / 2, stage.y + stage.height - 30];
    await touch("touchStart", [cx - 30, cy], [cx + 30, cy]);
    for (let i = 1; i <= 4; i++) await touch("touchMove", [cx - 30 - 8 * i, cy], [cx + 30 + 8 * i, cy]);
    await touch("touchEnd");
    check(name + ": two fingers zoom", (await tab.evaluate(() => view.scale)) > 1.3 * scale);
    await tap(tab.locator("#fit"));
    const place = await tab.evaluate(() => {
      const e = (outline.base + 2) % count(),
        all = [...found.edgeOf.keys()].filter((i) => found.edgeOf[i] === e);
      const i = all[all.length >> 1],
        box = stage.getBoundingClientRect();
      const [x, y] = toScreen(times(plus(at(found.point, i), at(found.point, (i + 1) % found.edgeOf.length)), 0.5));
      return [box.x + 1 + x, box.y + 1 + y];
    });
    // sent at once: a busy machine that answers late shall not make two taps of them
    await Promise.all([touch("touchStart", place), touch("touchEnd"), touch("touchStart", place), touch("touchEnd")]);
    check(
      name + ": a double tap on a line adds a corner",
      (await tab.locator("#corners button").count()) === count + 1,
    );
    await agrees(tab, name + ", telephone, added");
  }
  for (const summary of await tab.locator("summary").all()) await tap(summary);
  for (const width of [360, 320, 768]) {
    await tab.setViewportSize({ width, height: 740 });
    await settle(tab);
    const wide = await tab.evaluate(() => document.documentElement.scrollWidth);
    check(`${width} pixels: nothing to scroll sideways`, wide <= width, wide);
  }
  const small = await tab.evaluate(() =>
    [...document.querySelectorAll("button:not(#corners button, .bars button, .step), select")]
      .filter((e) => e.getClientRects().length && e.getBoundingClientRect().height < 40)
      .map((e) => e.id || e.textContent),
  );
  check("buttons are as tall as a finger is wide", small.length === 0, small);
  await close(tab, "telephone");
}

// --- the result is seen while a corner is dragged, on telephones ---------------------------------------------------------
const phones = [
  [390, 844, 844],
  [390, 844, 664], // what browsers leave between their bars
  [320, 568, 568],
  [320, 568, 460],
  [360, 640, 640],
];
for (const [width, height, window] of wanted("phone") ? phones : []) {
  const name = `${width} x ${height}, ${window} of it`;
  const { tab, touch } = await openTelephone({ width, height: window });
  const seen = () =>
    tab.evaluate(() =>
      ["#verdict", "#bars", "#stage"].filter((selector) => {
        const box = document.querySelector(selector).getBoundingClientRect();
        return box.top < 0 || box.bottom > innerHeight + 0.5 || box.left < 0 || box.right > innerWidth + 0.5;
      }),
    );
  if (window === height)
    check(name + ": as it opens, verdict, bars and drawing are seen", !(await seen()).length, await seen());
  for (const preset of ["octant", "h3", "cell"]) {
    await tap(tab.locator(`[data-preset=${preset}]`));
    check(`${name}, ${preset}: verdict, bars and drawing are seen`, !(await seen()).length, await seen());
    const [x, y] = await cornerPlace(tab, 0);
    const state = () =>
      tab.evaluate(() => [
        document.getElementById("verdict").textContent,
        [...document.querySelectorAll("#bars i")].map((bar) => bar.style.height).join(),
        stage.getBoundingClientRect().top,
      ]);
    const before = await state();
    await touch("touchStart", [x, y]);
    for (let i = 1; i <= 6; i++) await touch("touchMove", [x + 10 * i, y + 4 * i]);
    const during = await state();
    check(
      `${name}, ${preset}: both change while the finger is down`,
      before[0] !== during[0] && before[1] !== during[1],
      during,
    );
    check(`${name}, ${preset}: the drawing stays where it is`, before[2] === during[2], [before[2], during[2]]);
    check(`${name}, ${preset}: and all is still seen`, !(await seen()).length, await seen());
    const covered = await tab.evaluate(
      ([x, y]) => document.getElementById("bars").getBoundingClientRect().bottom > y,
      [x + 60, y + 24],
    );
    check(`${name}, ${preset}: the hand below the finger does not cover the bars`, !covered);
    await touch("touchEnd");
    await settle(tab);
  }
  for (const summary of await tab.locator("summary").all()) await tap(summary);
  const states = {
    "as it is": () => {},
    ellipsoid: () => document.querySelector("#kinds [value=ellipsoid]").click(),
    "a table": () =>
      load(
        "cell,x,y,z,nx,ny,nz\n" +
          ["one", "two"].map((id) => `${id},1,0,0,1,0,0\n${id},0,1,0,0,1,0\n${id},0,0,1,0,0,1\n`).join(""),
      ),
    "what is wrong with a table": () => load("x,y\n0,0\n" + "long".repeat(100) + ",0\n"),
    help: () => {
      document.querySelector("dialog[open]").close();
      document.getElementById("help").showModal();
    },
  };
  for (const [state, go] of Object.entries(states)) {
    await tab.evaluate(go);
    await settle(tab);
    const wide = await tab.evaluate(() => [
      document.documentElement.scrollWidth,
      ...[...document.querySelectorAll("dialog[open]")].flatMap((e) => [
        e.scrollWidth,
        e.getBoundingClientRect().right,
      ]),
    ]);
    check(`${name}, ${state}: nothing to scroll sideways`, Math.max(...wide) <= width, wide);
  }
  await close(tab, name);
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
if (wanted("light")) {
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
