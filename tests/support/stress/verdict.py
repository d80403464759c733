"""Pass lines, and what the exit status makes of them."""
import os


class Verdict:
    """Prints a line for each thing that was asked and counts those that fell short."""

    def __init__(self) -> None:
        self.asked = 0
        self.short: list[str] = []

    def ask(self, what: str, holds: object, got: object = "") -> bool:
        self.asked += 1
        if not holds:
            self.short.append(what)
        print(f"{'ok   ' if holds else 'SHORT'} {what}{': ' if got != '' else ''}{got}", flush=True)
        return bool(holds)

    @staticmethod
    def say(what: str, **figures: object) -> None:
        """Figures that nothing is asked of, with the load average that they stood under."""
        figures["load"] = round(os.getloadavg()[0], 1)
        print("     " + what + ": " + ", ".join(f"{name} {value}" for name, value in figures.items()), flush=True)

    def exit_status(self, command: str) -> int:
        print(f"{command}: {self.asked} asked, {len(self.short)} short" +
              (": " + "; ".join(self.short) if self.short else ""))
        return 1 if self.short else 0


def percentile(values: list[float], share: float) -> float:
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def milliseconds(values: list[float]) -> str:
    """p50, p99 and the greatest of some seconds."""
    if not values:
        return "none"
    return "/".join(f"{percentile(values, share) * 1000:.1f}" for share in (.5, .99, 1)) + " ms (p50/p99/most)"
