// A line for each assertion.
const counts = { ok: 0, failed: 0, skipped: 0 };

// Runs `body`; what it throws is what is wrong, and a text that it returns is said beside the name.
export const claim = async (name, body) => {
  try {
    const said = await body();
    counts.ok += 1;
    console.log(`ok      ${name}${typeof said === 'string' ? `: ${said}` : ''}`);
  } catch (wrong) {
    counts.failed += 1;
    console.log(`FAILED  ${name}: ${wrong.message}`);
  }
};

export const skipped = (name, why) => {
  counts.skipped += 1;
  console.log(`skipped ${name}: ${why}`);
};

export const expect = (holds, what) => {
  if (!holds) throw new Error(what);
};

export const same = (given, wanted, what) =>
  expect(JSON.stringify(given) === JSON.stringify(wanted),
         `${what} is ${JSON.stringify(given)}, not ${JSON.stringify(wanted)}`);

// The exit status.
export const finish = () => {
  console.log(`contract: ${counts.ok} hold, ${counts.failed} do not, ${counts.skipped} skipped`);
  return counts.failed ? 1 : 0;
};
