/** Files that the reader chooses or drops: traverses folders, and decodes images if the Lab cannot. */

/** Formats decoded by the Lab itself, with the same pixels in every browser. */
const ITS_OWN = /\.(png|jpe?g|webp|tiff?|bmp|p[bgpn]m|zip)$/i;
/** Formats decoded by some browsers. */
const FOREIGN = /\.(hei[cf]|avif|gif|jxl)$/i;
/** Files that may contain cameras; the Lab decides by content. */
const CAMERA = /\.(ya?ml|json|xml|txt|bin|out)$/i;
/** Files of models with poses. The points of a model are not read. */
const MODEL = /^((cameras|images|rigs|frames)\.(txt|bin)|transforms\.json|sfm_data\.json)$/i;
const QUALITY = 0.95;

/** Whether a file may contain cameras, by its name. */
export function isCamera(file: File): boolean {
  return CAMERA.test(file.name);
}

/** Whether a file is a photograph or a project, by its name or the type given by the browser. */
export function isPhotographOrProject(file: File): boolean {
  return ITS_OWN.test(file.name) || FOREIGN.test(file.name) || file.type.startsWith("image/");
}

/** Returns the dropped files, including those in dropped folders, sorted by name. */
export async function dropped(transfer: DataTransfer): Promise<File[]> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.() ?? null);
  if (!entries.some((entry) => entry?.isDirectory)) return [...transfer.files];
  const files: File[] = [];
  for (const entry of entries) if (entry) await walk(entry, files);
  // From a folder, only photographs, videos, projects, and the first model are used.
  const models = new Set<string>();
  const isFirst = (name: string) => MODEL.test(name) && models.size < models.add(name.toLowerCase()).size;
  return files.filter((file) => isPhotographOrProject(file) || file.type.startsWith("video/") || isFirst(file.name));
}

async function walk(entry: FileSystemEntry, files: File[]): Promise<void> {
  if (entry.isFile) {
    files.push(await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)));
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const within: FileSystemEntry[] = [];
  // readEntries returns a batch at a time, and an empty one at the end.
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) break;
    within.push(...some);
  }
  within.sort((a, b) => (a.name < b.name ? -1 : 1));
  for (const one of within) await walk(one, files);
}

/**
 * Returns a photograph in a format that the Lab reads; undefined if it cannot be decoded. `foreign`: decoded by the
 * browser.
 */
export async function photographOf(
  file: File,
): Promise<{ name: string; bytes: Uint8Array; foreign: boolean } | undefined> {
  const as = (name: string, blob: Blob, foreign: boolean) =>
    blob.arrayBuffer().then((bytes) => ({ name, bytes: new Uint8Array(bytes), foreign }));
  if (ITS_OWN.test(file.name)) return as(file.name, file, false);
  try {
    const picture = await createImageBitmap(file);
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [picture.width, picture.height];
    canvas.getContext("2d")?.drawImage(picture, 0, 0);
    picture.close();
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/jpeg", QUALITY));
    if (blob) return await as(`${file.name}.jpg`, blob, true);
  } catch {
    // The caller reports the failure.
  }
  return undefined;
}
