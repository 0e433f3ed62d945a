import { Menu } from '@mantine/core';
import { exportLabel, type Format } from '../api/formats';
import { FORMATS } from '../api/types.gen';

/** Menu items that save a show as a file, one for each format. */
export const ExportItems = ({ onExport }: { onExport: (format: Format) => void }) =>
  FORMATS.map((format) => (
    <Menu.Item key={format.name} onClick={() => onExport(format)}>
      {exportLabel(format)}
    </Menu.Item>
  ));
