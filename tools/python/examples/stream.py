"""Streams commands to a running controller: `halfstep walk --instance default` in one terminal, this in another."""

import sys
import time

from halfstep import Intent, Observer, Operator

COMMANDS = [dict(turn_deg=15), dict(turn_deg=0, speed=1.2), dict(extension_deg=5), dict(intent=Intent.WALK)]

operator, observer = Operator(*sys.argv[1:]), Observer(*sys.argv[1:])
for command in COMMANDS:
    answer = operator.ask(**command)
    print(command, answer.verdict.name, answer.reason.name, f"from half-step {answer.effect_half_step} on")
    time.sleep(1.0)
    if report := observer.newest():
        print(f"half-step {report.half_step}, speed {report.speed:.2f}, margin {1e3 * report.margin:.0f} mm")
