// Looks at the page of a run in Chromium: node page.mjs FOLDER FOLDER_WITH_NODE_MODULES CHROMIUM
// Libraries have drawn empty charts without any error, so what is drawn is counted.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [, , folder, modules, executablePath] = process.argv;
const { chromium } = createRequire(resolve(modules, "x.js"))("playwright-core");

const run = `${folder}/run`;

let failed = 0;
function check(what, holds, seen) {
  if (!holds) ++failed;
  console.log(
    `${holds ? "ok    " : "FAILED"} ${what}${seen === undefined ? "" : `: ${JSON.stringify(seen)}`}`,
  );
}

const rows = (csv) => readFileSync(`${run}/${csv}`, "utf8").trim().split("\n").length - 1;

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
const troubles = [],
  requests = [];
page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
page.on("pageerror", (error) => troubles.push(error.message));
page.on("request", (request) => requests.push(request.url()));
await page.goto(`file://${resolve(run, "report.html")}`);
await page.waitForSelector("canvas[data-triangles]");
await page.waitForSelector('[data-chart="penetration"] svg');

/** Points of every line of a chart: the numbers of M and L in its paths. */
const points = (chart) =>
  page
    .locator(`[data-chart="${chart}"] g.curve path`)
    .evaluateAll((paths) =>
      paths.map((path) => (path.getAttribute("d").match(/[ML]/g) ?? []).length),
    );
const marks = (chart, kind) => page.locator(`[data-chart="${chart}"] g.${kind} circle`).count();

/** Share of coloured pixels in each half of a picture, and their mean place across (0 ... 1). */
async function covered(png) {
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height),
      context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const top = 40; // below the names
    const halves = [
      { n: 0, x: 0, y: 0 },
      { n: 0, x: 0, y: 0 },
    ];
    for (let y = top; y < image.height - 2; ++y)
      for (let x = 2; x < image.width - 2; ++x) {
        const i = 4 * (y * image.width + x);
        if (data[i] + data[i + 1] + data[i + 2] > 740) continue;
        const half = halves[x < image.width / 2 ? 0 : 1];
        (half.n++, (half.x += ((x / image.width) * 2) % 1), (half.y += y / image.height));
      }
    const area = ((image.height - top) * image.width) / 2;
    return halves.map(({ n, x, y }) => ({ share: n / area, x: x / n, y: y / n }));
  }, png.toString("base64"));
}
const canvas = page.locator("canvas");
const picture = () => canvas.screenshot();

const rod = rows("rod/force.csv"),
  solid = rows("solid/force.csv");
for (const chart of ["force-log", "force-linear", "energy"])
  check(
    `${chart}: a point a row`,
    String(await points(chart)).endsWith(`${rod},${solid}`),
    await points(chart),
  );
check("measured points are there", (await marks("force-log", "measured")) === 3);
check("iterations: a mark a row", (await marks("iterations", "steps")) === rod + solid);
check("residual: a mark a row", (await marks("residual", "steps")) === rod + solid);
const curved = await points("curvature ebar_+019.000");
check("curvature of both", curved.length === 2 && curved.every((n) => n > 30), curved);
const pairs = await marks("contacts ebar_+019.000", "pairs");
check("a mark a contact", pairs === rows("rod/contacts/ebar_+019.000.csv"), pairs);
check("contact force of every state", (await points("rod contact_force")).length === 4);
check("title", (await page.locator("h1").textContent()) === "Test & <small> knot");
check("states in the table", (await page.locator("section:nth-of-type(2) tbody tr").count()) === 4);

const triangles = Number(await canvas.getAttribute("data-triangles"));
check("triangles", triangles > 2 * 24 * 120, triangles);
const first = await picture(),
  seen = await covered(first);
check(
  "rod and solid are drawn",
  seen.every(({ share }) => share > 0.03),
  seen,
);
check(
  "the knots are centred",
  seen.every(({ x, y }) => Math.abs(x - 0.5) < 0.12 && Math.abs(y - 0.5) < 0.12),
);

await page.locator("input[type=range]").fill("0");
check(
  "the slider shows the first state",
  (await canvas.getAttribute("data-state")) === "ebar_+030.000",
);
check(
  "the solid is not there yet",
  (await page.locator(".names").textContent()).includes("no state recorded here"),
);
const loose = await covered(await picture());
check("the rod alone is drawn", loose[0].share > 0.03 && loose[1].share === 0, loose);

await page.getByRole("button", { name: "Play" }).click();
await page.waitForFunction(
  () => document.querySelector("canvas").dataset.state === "ebar_+019.000",
);
check("play ends at the last state", true);
const box = await canvas.boundingBox();
await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2);
await page.mouse.down();
await page.mouse.move(box.x + box.width / 4 + 120, box.y + box.height / 2 + 60, { steps: 5 });
await page.mouse.up();
const turned = await picture();
check("dragging turns it", !turned.equals(first));
await page.mouse.wheel(0, 600);
await page.waitForTimeout(200);
const small = await covered(await picture());
check("the wheel zooms", small[0].share < 0.8 * (await covered(turned))[0].share, small);
await page.getByRole("button", { name: "Knot" }).click();
check("and back", (await covered(await picture()))[0].share > 1.2 * small[0].share);
for (const field of ["contact_force"]) await page.getByLabel("colour of rod").selectOption(field);
for (const field of ["von_mises", "J", "pressure"])
  await page.getByLabel("colour of solid").selectOption(field);
check("fields can be chosen", !(await picture()).equals(first));

await page.setViewportSize({ width: 390, height: 800 });
await page.waitForTimeout(300);
const wide = await page.evaluate(() => document.documentElement.scrollWidth);
check("a narrow window is not overflown", wide <= 390, wide);

const another = (of) => page.goto(`file://${resolve(folder, of, "report.html")}`);
await another("unfinished");
await page.waitForSelector('[data-chart="penetration"] svg');
const outcome = await page.locator("dl.facts").textContent();
check("an unfinished run says so", outcome.includes("not finished"));
check("and is drawn", (await canvas.getAttribute("data-triangles")) > 0);
check("nothing went wrong", troubles.length === 0, troubles);

await another("odd");
await page.waitForSelector('[data-chart="penetration"] svg');
const text = await page.locator("main").textContent();
check("a part that fails says so, alone", text.split("A part of this page failed").length === 2);
check("and to the console", troubles.length === 1, troubles);
troubles.length = 0;
await another("study");
await page.waitForSelector('[data-chart="pareto"] svg');
const runs = await page.locator('[data-chart="pareto"] g.runs path').count();
check("study: a mark a run with an error", runs === 2, runs);
check("study: the front is joined", String(await points("pareto")) === "2");
check("study: a row a run", (await page.locator("#study tbody tr").count()) === 4);

check("nothing went wrong", troubles.length === 0, troubles);
check(
  "nothing was loaded",
  requests.every((url) => /^(file|data|blob):/.test(url)) &&
    requests.filter((url) => url.startsWith("file:")).length === 4,
  requests.map((url) => url.slice(0, 60)),
);
await browser.close();
process.exit(failed > 0 ? 1 : 0);
