// The two views of the page, the walk and the paper; the address says which one: with #paper it is the paper.

const VIEWS = ['walk', 'paper'];
const chosen = () => (location.hash === '#paper' ? 'paper' : 'walk');

/** Keys are for the walk only where it is seen. Sliders and lists hear them all the same: that is the browser's. */
function keepKeys(event) {
  if (chosen() === 'paper') event.stopPropagation();
}

/** Calls with the view that is shown: now, and whenever it is another one. */
export function onView(show) {
  const buttons = VIEWS.map((view) => document.getElementById(`view-${view}`));
  const turn = () => {
    const now = chosen();
    document.body.dataset.view = now;
    buttons.forEach((button, index) => button.setAttribute('aria-pressed', VIEWS[index] === now));
    show(now);
  };
  buttons.forEach((button, index) => {
    button.onclick = () => {
      location.hash = VIEWS[index];
      button.blur();
    };
  });
  ['keydown', 'keyup'].forEach((kind) => addEventListener(kind, keepKeys, true));
  addEventListener('hashchange', turn);
  turn();
}
