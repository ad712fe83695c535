// The page of `halfstep view`.
import { Connection } from './connection.js';
import { openPage } from './page.js';

openPage((handlers) => new Connection(handlers));
