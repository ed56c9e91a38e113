// Words of measured data, of files, links and notices.

import type { Row } from "./words";

export const out = {
  data_drop: [
    "Drop a table here (time, angle), or choose a file.",
    "Suelte aquí una tabla (tiempo, ángulo) o elija un archivo.",
  ],
  data_choose: ["Choose a file", "Elegir un archivo"],
  data_private: ["The file stays on this device.", "El archivo no sale de este dispositivo."],
  data_time: ["Time", "Tiempo"],
  data_angle: ["Angle", "Ángulo"],
  data_unit: ["Unit", "Unidad"],
  data_degrees: ["degrees", "grados"],
  data_radians: ["radians", "radianes"],
  data_from: ["Counted from", "Contado desde"],
  data_bottom: ["the lowest point", "el punto más bajo"],
  data_top: ["the top", "la cima"],
  data_column: ["column {number}", "columna {number}"],
  data_start: ["Start the run as measured", "Empezar como lo medido"],
  data_forget: ["Take it away", "Quitarlo"],
  data_title: ["Measured and computed", "Medido y calculado"],
  data_text: [
    "{count} measured points over {span} s beside the run; their root mean square difference is {rms}°.",
    "{count} puntos medidos en {span} s junto al cálculo; la diferencia cuadrática media es {rms}°.",
  ],
  data_fit: ["The fit, in Python:", "El ajuste, en Python:"],
  share: ["Share", "Compartir"],
  copy_link: ["Copy the link", "Copiar el enlace"],
  copy_python: ["Copy as Python", "Copiar como Python"],
  copy_embed: ["Copy for embedding", "Copiar para incrustar"],
  save_csv: ["Numbers (CSV)", "Números (CSV)"],
  save_png: ["Picture (PNG)", "Imagen (PNG)"],
  save_svg: ["Picture (SVG)", "Imagen (SVG)"],
  record: ["Record a video", "Grabar un vídeo"],
  record_stop: ["Stop recording", "Detener la grabación"],
  copied: ["Copied.", "Copiado."],
  saved: ["Saved as {name}.", "Guardado como {name}."],
  not_copied: [
    "The browser did not allow copying; the text is below.",
    "El navegador no permitió copiar; el texto está abajo.",
  ],
  link_wrong: ["This link is not shown: {why}", "Este enlace no se muestra: {why}"],
  start_afresh: ["Open the laboratory afresh", "Abrir el laboratorio de nuevo"],
  core_missing: [
    "The core could not be started: {why}. Reload the page.",
    "No se pudo iniciar el núcleo: {why}. Recargue la página.",
  ],
  core_trapped: [
    "A computation broke down and its worker was replaced; the page goes on.",
    "Un cálculo falló y su proceso fue reemplazado; la página continúa.",
  ],
  embed_open: ["Open in the laboratory", "Abrir en el laboratorio"],
  help: ["Keyboard", "Teclado"],
  help_text: [
    "Space plays and pauses; comma and full stop step; Tab reaches the bob, arrow keys turn it.",
    "Espacio reproduce y pausa; coma y punto avanzan un paso; Tab llega a la masa y las flechas la giran.",
  ],
  close: ["Close", "Cerrar"],
} as const satisfies Record<string, Row>;
