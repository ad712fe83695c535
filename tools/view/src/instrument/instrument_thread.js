// The thread that computes the paper's figures, beside the page: a question, and its answer.
//
// In: `{ module }`, then `{ ask }` with a question. Out: `{ told, seconds }`, what the module says: what can be turned,
// then an answer for each question.
import { ModuleTexts } from '../walk_here/module_texts.js';

let paper = null;
let texts = null;

function tell(began) {
  const [told] = texts.said().map((text) => JSON.parse(text));
  postMessage({ told, seconds: (performance.now() - began) / 1e3 });
}

onmessage = async ({ data: { module, ask } }) => {
  const began = performance.now();
  if (module) {
    paper = (await WebAssembly.instantiate(module, {})).exports;
    texts = new ModuleTexts(paper);
    paper.halfstep_paper();
  } else {
    texts.give(JSON.stringify(ask));
    paper.halfstep_ask();
  }
  tell(began);
};
