// What people call the dials, in groups, and in which unit they read them.

/** Units by the ends of the names: what one unit of the module is in that of people, and how that is written. */
const UNITS = [['_share', 100, '%'], ['_deg', 1, '°'], ['_m', 100, 'cm'], ['_s', 1, 's']];

export const GROUPS = [
  ['Half-step', [
    ['step_length_m', 'step length'], ['duration_s', 'duration T'], ['extension_deg', 'extended step β'],
    ['clearance_m', 'swing foot height'], ['pelvis_sway_m', 'pelvis sway'],
    ['pelvis_setback_m', 'pelvis setback'],
  ]],
  ['Sole, seen from the ankle', [
    ['heel_m', 'heel'], ['toe_m', 'toe'], ['inside_m', 'inside'], ['outside_m', 'outside'],
  ]],
  ['Heights and widths', [
    ['stature_share', 'stature'], ['hip_height_share', 'hip height'], ['hip_distance_m', 'between the hips'],
  ]],
  ['Masses, the pelvis as it is', [
    ['trunk_mass_share', 'trunk and head'], ['leg_mass_share', 'legs'], ['arm_mass_share', 'arms'],
  ]],
  ['How it is read', [
    ['turn_ramp', 'turn grows'], ['extension_ramp', 'extension grows'], ['axes', 'joint 3 / joint 4'],
  ]],
];

/** What choices are called that files name otherwise. */
export const CHOICES = {
  'mechanism.toml': 'roll / pitch', 'mechanism_other_reading.toml': 'pitch / roll',
  linear: 'in equal increments', quintic: 'smoothly',
};

/** Writes a value of the module for people, with as many decimals as its grain has. */
export function reader(name, grain) {
  const [, factor, unit] = UNITS.find(([end]) => name.endsWith(end)) ?? ['', 1, ''];
  const decimals = Math.max(0, Math.ceil(-Math.log10(grain * factor) - 1e-9));
  const space = unit === '°' ? '' : '\u2009';
  return (value) => `${(value * factor).toFixed(decimals)}${space}${unit}`;
}
