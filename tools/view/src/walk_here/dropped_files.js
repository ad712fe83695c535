// Files that are dropped on the page: the URDF of a robot, and with it, if the URDF lacks a sole, a map of it.

export async function readDropped(files) {
  const named = async (file) => ({ name: file.name, text: await file.text() });
  const all = [...files];
  const urdf = all.find(({ name }) => /\.(urdf|xml)$/i.test(name));
  const map = all.find(({ name }) => /\.toml$/i.test(name));
  if (!urdf) throw new Error('drop the URDF of a biped here, a file that ends with .urdf');
  return { urdf: await named(urdf), map: map ? await named(map) : null };
}
