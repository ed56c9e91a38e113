import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { computed, hasChromium, type Laboratory, laboratory, RODS, STILL } from "./laboratory";

// What pendula rerun gives for it: its energies, work and heat; 9.8 J times its energy error.
const BALANCE =
  "Kinetic 0.04806 J, potential 0.3839 J; since the start −1.468 J of work went in and 2.609 J of heat out: " +
  "the energy is off their balance by 1.5 · 10⁻¹⁵ J.";

describe.skipIf(!hasChromium)("the page", () => {
  let lab: Laboratory;
  beforeAll(async () => {
    lab = await laboratory();
  });
  afterAll(() => lab?.close());

  test("starts moving, keeps its policy, and asks only its own server", async () => {
    const began = Date.now();
    const { page, said, asked } = await lab.open();
    await page.waitForFunction(
      () => Number.parseFloat(document.querySelector(".clock")?.textContent ?? "0") > 0,
    );
    console.info(`first motion after ${Date.now() - began} ms`);
    expect(said).toStrictEqual([]);
    expect(
      asked.filter((each) => !each.startsWith(lab.url) && !/^(data|blob):/.test(each)),
    ).toStrictEqual([]);
  });

  test("stands still where a person asks for less motion", async () => {
    const { page } = await lab.open("", STILL);
    await computed(page);
    expect(await page.textContent(".clock")).toBe("0.000 s");
    expect(await page.getAttribute(".round.main", "aria-label")).toBe("Play");
  });

  test("by keyboard alone: the bob is turned and spoken, the address follows, space plays", async () => {
    const { page } = await lab.open("#system=simple&state=0.5,0&t_max=20", STILL);
    await computed(page);
    const bob = page.getByRole("slider", { name: /Bob/ });
    await bob.focus();
    await page.keyboard.press("PageUp");
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction(
      () => document.querySelector(".bob")?.getAttribute("aria-valuetext") === "37.6 degrees",
    );
    await page.waitForFunction(() => location.hash.includes("state=0.656"));
    await page.keyboard.press("Space");
    await page.waitForFunction(
      () => Number.parseFloat(document.querySelector(".clock")?.textContent ?? "0") > 0.2,
    );
  });

  test("dragging sets the start, letting go in motion throws", async () => {
    const { page } = await lab.open("#system=simple&state=0.5,0&t_max=20", STILL);
    await computed(page);
    const box = (await page.locator(".bob").boundingBox())!;
    const [x, y] = [box.x + 22, box.y + 22];
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 1; i <= 8; ++i) await page.mouse.move(x + 12 * i, y - 5 * i);
    await page.mouse.up();
    await page.waitForFunction(() => /state=[^,]+,(?!0&)/.test(location.hash));
    expect(await page.getAttribute(".round.main", "aria-label")).toBe("Pause");
  });

  test("a wrong link gets one line that names the key, in its language", async () => {
    const { page } = await lab.open("#system=simple&t_max=10&lenght=1&lang=es");
    const line = await page.getByRole("alert").textContent();
    expect(line).toMatch(/^Este enlace no se muestra: «lenght» .+\.$/);
  });

  test("a typed value that breaks a rule is not taken, and a line says why", async () => {
    const { page } = await lab.open("#system=simple&t_max=10", STILL);
    const length = page.getByRole("textbox", { name: /length/ });
    await length.fill("-1");
    await length.press("Enter");
    expect(await page.getByText("must be positive").textContent()).toContain("−1");
    await length.fill("2,5");
    await length.press("Enter");
    await page.waitForFunction(() => location.hash.includes("length=2.5"));
  });

  test("the clock of trust: a coarse run is right for a while only", async () => {
    const { page } = await lab.open(`#${RODS}&t_max=30&method=rk4&step=0.01&lang=en`, STILL);
    await page.waitForFunction(() =>
      /until [\d.]+ s/.test(document.querySelector(".readings")?.textContent ?? ""),
    );
  });

  test("a table of measured motion is laid over the run, a bad one gets one line", async () => {
    const { page } = await lab.open("#system=simple&t_max=10&view=data&lang=en", STILL);
    await computed(page);
    const file = (text: string) => ({
      name: "swing.csv",
      mimeType: "text/csv",
      buffer: Buffer.from(text),
    });
    await page.setInputFiles("input[type=file]", file("t,theta\n0,0.5\n0.1,oops\n"));
    const line = page.locator(".view .wrong").filter({ hasText: /./ }); // the file is read meanwhile
    expect(await line.textContent()).toBe("Line 3, column 2: “oops” is no number.");
    await page.setInputFiles("input[type=file]", { ...file("PK"), name: "swing.xlsx" });
    await page.getByText("read this one in Python: pendula fit swing.xlsx").waitFor();
    await page.setInputFiles("input[type=file]", file("t;θ (°)\n0,0;30\n0,1;29\n0,2;25\n"));
    await page.getByRole("button", { name: "Start the run as measured" }).click();
    await page.waitForFunction(() => location.hash.includes("t_max=0.2"));
    expect(await page.locator("pre.code").textContent()).toContain('unit="deg"');
    await page.setInputFiles("input[type=file]", { ...file("PK"), name: "swing.mat" });
    await page.getByText("pendula fit swing.mat").waitFor(); // beside the table that stays
  });

  test("three ghosts move with the run, frame by frame", async () => {
    const { page } = await lab.open(`#${RODS}&t_max=30&view=compare&compare=rk4,dop853,gauss4`);
    await page.waitForFunction(() => document.querySelectorAll(".view tbody tr").length === 3);
    await page.waitForFunction(() => performance.getEntriesByName("render").length > 60);
    const picture = () =>
      page
        .locator("canvas")
        .first()
        .evaluate((stage) => (stage as HTMLCanvasElement).toDataURL());
    const before = await picture();
    await page.waitForFunction(() => performance.getEntriesByName("render").length > 120);
    expect(await picture()).not.toBe(before); // how long a frame takes: benchmarks/lab.py
  });

  test("the flip map: a click puts the start on the stage", async () => {
    const { page } = await lab.open(`#${RODS}&t_max=30&view=map&map_t_max=5&lang=en`, STILL);
    await page.getByText("no turn until 5 s", { exact: true }).waitFor();
    await page.getByText(/64 × 64|128 × 128/).waitFor();
    const box = (await page.locator(".map canvas").boundingBox())!;
    await page.mouse.click(box.x + box.width * 0.95, box.y + box.height * 0.5);
    await page.waitForFunction(() => !location.hash.includes("state=2.0943951023931953"));
    await page.getByLabel("Shown").selectOption({ label: "MEGNO: regular or chaotic" });
    await page.waitForFunction(() => /map_quantity=megno&map_t_max=5$/.test(location.hash));
    expect(await page.getByText(/turns over after [\d.]+ s/).textContent()).toContain("rod");
  });

  test("work and heat beside the energies: those of pendula, at the end of the run", async () => {
    const drive = "system=driven&form=bob&viscous=0.2&torque=1&drive_frequency=2";
    const { page } = await lab.open(`#${drive}&state=1,0&t_max=10&every=0.005&lang=en`, STILL);
    const said = page.getByText(/of work went in/);
    await said.waitFor({ state: "attached" });
    await page.getByRole("slider", { name: "Time of the motion" }).press("End");
    await page.waitForFunction(() => document.querySelector(".clock")?.textContent === "10.000 s");
    expect(await said.textContent()).toBe(BALANCE);
  });

  test("embedded: the stage and its controls alone", async () => {
    const { page } = await lab.open("#system=simple&t_max=10&embed=1&lang=en", STILL);
    await computed(page);
    expect(await page.getByRole("tablist").count()).toBe(0);
    expect(await page.getByRole("button", { name: "Play" }).count()).toBe(1);
  });
});
