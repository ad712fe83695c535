// The gait parameters: sliders that ask for them and show those in force.

const degrees = (angle) => Math.round((angle * 180) / Math.PI);
/** Key of a command, label, least, most, step, unit, and the value as a frame's `gait` has it. */
const PARAMETERS = [
  ['speed', 'speed', 0.5, 1.7, 0.05, '', ([speed]) => Math.round(speed * 20) / 20],
  ['turn_deg', 'turn', -46, 46, 1, '°', ([, turn]) => degrees(turn)],
  ['extension_deg', 'extension', -38, 20, 1, '°', ([, , extension]) => degrees(extension)],
  ['sidestep_deg', 'sidestep', -16, 16, 1, '°', ([, , , sidestep]) => degrees(sidestep)],
];

export class GaitSliders {
  constructor(parent, command) {
    this.sliders = PARAMETERS.map(([key, label, min, max, step, unit, inForce]) => {
      const row = document.createElement('label');
      const [name, input, output] = ['span', 'input', 'output'].map((tag) => document.createElement(tag));
      name.textContent = label;
      Object.assign(input, { type: 'range', min, max, step });
      const show = () => { output.textContent = `${input.value}${unit}`; };
      input.oninput = show;
      input.onchange = () => command({ [key]: Number(input.value) });
      row.append(name, input, output);
      parent.append(row);
      return { input, show, inForce };
    });
  }

  /** Shows the gait parameters in force, except on a slider that is being moved. */
  show(gait) {
    this.sliders.filter(({ input }) => !input.matches(':active')).forEach(({ input, show, inForce }) => {
      input.value = inForce(gait);
      show();
    });
  }
}
