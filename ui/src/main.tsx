import '@mantine/core/styles.css';
import './style/tokens.css';
import './style/base.css';
import './style/mantine.css';
import { createRoot } from 'react-dom/client';
import { App } from './App';
import { followFocus } from './parts/focusOrigin';

const root = document.getElementById('root');
if (!root) throw new Error('The page has no root.');
followFocus(document);
createRoot(root).render(<App />);
