// The first gamepad that is connected, in the standard layout of the browser's Gamepad API.

/** Deflections of a stick that count as none. */
const DEAD_ZONE = 0.12;

/** Ahead, left and turn, each within ±1, and whether its B button is pressed; null without a gamepad. */
export function readGamepad() {
  const gamepad = [...(navigator.getGamepads?.() ?? [])].find((one) => one?.connected);
  if (!gamepad) return null;
  const axis = (index) => {
    const value = gamepad.axes[index] ?? 0;
    return Math.abs(value) < DEAD_ZONE ? 0 : -value;
  };
  return { velocity: [axis(1), axis(0), axis(2)], stops: Boolean(gamepad.buttons[1]?.pressed) };
}
