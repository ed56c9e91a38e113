// Files and texts that leave the page: saved, copied, recorded. Nothing is sent anywhere.

/** Saves data as a file. */
export function save(name: string, data: BlobPart, type: string): void {
  const link = document.createElement("a");
  const address = URL.createObjectURL(new Blob([data], { type }));
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Copies a text; false: the browser does not allow it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** A recording of a canvas by the browser's own recorder; `stop` saves it. */
export function record(canvas: HTMLCanvasElement, name: string): () => void {
  const type =
    ["video/mp4", "video/webm"].find((each) => MediaRecorder.isTypeSupported(each)) ?? "";
  const recorder = new MediaRecorder(canvas.captureStream(60), type ? { mimeType: type } : {});
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  recorder.onstop = () => {
    const ending = recorder.mimeType.includes("mp4") ? "mp4" : "webm";
    save(`${name}.${ending}`, new Blob(parts), recorder.mimeType);
  };
  recorder.start();
  return () => recorder.stop();
}
